// Fits the built-in brushed brass and says what anisotropy is worth; with an argument, draws both fits there.

#include <cstdio>
#include <string>
#include <vector>

#include "brdf/analytic/synthetic.hpp"
#include "brdf/data/isotropy.hpp"
#include "brdf/model/anisotropic_fit.hpp"
#include "brdf/model/refined_fit.hpp"
#include "brdf/render/turned_sphere.hpp"
#include "brdf/study/figures.hpp"

int main(int argc, char** argv) {
  using namespace sklar::brdf;
  const AnisotropicGrid coarse{.theta_h = 40, .phi_h = 72, .theta_d = 24, .phi_d = 16, .turns = 2, .mirrored = true};
  const AnisotropicTable table = builtin_anisotropic_material({.scatter = 0, .grid = coarse});
  const AnisotropicFit fit = fit_anisotropic(table, {.evaluations = 400});
  const RefinedFit round =
      fit_refined(isotropic_mean(table),
                  {.structure = {.components = 4, .half = 14, .difference = 8}, .bits = 12, .evaluations = 200});

  std::printf("isotropy deviation %.2f\n", table.report.isotropy_deviation);
  const auto report = [&](const char* name, const Brdf& brdf) {
    const CellErrors errors = cell_errors(table, brdf);
    std::printf("%-12s %4zu bytes  log1p_mae %.4f  logrel_mae %.3f\n", name, brdf.bytes(), errors.log1p_mae.mean(),
                errors.logrel_mae.mean());
  };
  report("anisotropic", *fit.brdf);
  report("isotropic", *round.brdf);
  if (argc < 2) return 0;
  const Image reference = render_turned_sphere(*brushed_metal());
  const Image anisotropic = render_turned_sphere(*fit.brdf), isotropic = render_turned_sphere(*round.brdf);
  const auto label = [](const char* name, const Brdf& brdf) {
    return std::string(name) + ", " + std::to_string(brdf.bytes()) + " bytes";
  };
  const std::vector<SpherePair> columns = {{label("anisotropic", *fit.brdf), &reference, &anisotropic},
                                           {label("isotropic", *round.brdf), &reference, &isotropic}};
  write_sphere_figure(argv[1], "synthetic-anisotropic: brushed brass", columns);
}
