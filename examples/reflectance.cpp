// A material, a model of it, and what a renderer asks of the model:
//     reflectance [MODEL.sklar]

#include <cmath>
#include <cstdio>

#include "brdf/analytic/synthetic.hpp"
#include "brdf/model/model_io.hpp"
#include "brdf/model/refined_fit.hpp"
#include "brdf/sampling/sampled_brdf.hpp"
#include "brdf/study/albedo.hpp"
#include "brdf/study/metrics.hpp"
#include "copula/random.hpp"

int main(int argc, char** argv) {
  using namespace sklar::brdf;
  const MeasuredTable material = builtin_material();  // or load_material("FILE.bsdf"), of brdf/data/material.hpp
  const RefinedFit fit = fit_refined(
      material, {.structure = {.components = 2, .half = 12, .difference = 8}, .bits = 12, .evaluations = 60});
  const CellErrors errors = cell_errors(material, predict(*fit.brdf, material));
  std::printf("%zu bytes, log1p_mae %.4f\n", fit.brdf->bytes(), errors.log1p_mae.mean());
  if (argc > 1) write_brdf(argv[1], {material.name, material.provenance, fit.brdf});  // read_brdf(..).brdf() reads it

  const SampledBrdf model(fit.brdf);                 // evaluates as the model does, and has a sampler made for it
  const Vec3 wo(0.6, 0, 0.8), mirror(-0.6, 0, 0.8);  // unit vectors away from the surface, z its normal
  const Rgb value = model.eval(wo, mirror);          // f_r, 1/sr, without the cosine
  std::printf("f_r of the mirror direction  %.4f %.4f %.4f\n", value[0], value[1], value[2]);

  sklar::Rng rng(1);
  constexpr int kDraws = 20000;
  Rgb sum = Rgb::Zero();
  for (int i = 0; i < kDraws; ++i) {
    sum += model.sample(wo, {sklar::uniform(rng), sklar::uniform(rng)}).weight;  // f_r cos(theta_i) / pdf
  }
  const AlbedoCurve exact = directional_albedo(model, Eigen::ArrayXd::Constant(1, std::acos(wo.z())));
  std::printf("albedo by draws       %.4f %.4f %.4f\n", sum[0] / kDraws, sum[1] / kDraws, sum[2] / kDraws);
  std::printf("albedo by quadrature  %.4f %.4f %.4f\n", exact.albedo(0, 0), exact.albedo(0, 1), exact.albedo(0, 2));
}
