#include <tbb/parallel_for.h>

#include <numeric>
#include <stdexcept>

#include "brdf/data/cell_directions.hpp"
#include "brdf/data/isotropy.hpp"
#include "brdf/data/rgl.hpp"
#include "brdf/data/tabulate.hpp"

namespace sklar::brdf {
namespace {

/// |f(wi,wo) - f(wo,wi)| / mean, channels summed; negative where it has no meaning.
double asymmetry_of(const Rgb& forward, const Rgb& backward) {
  const double mean = 0.5 * (forward + backward).sum();
  return mean > 0 ? (forward - backward).abs().sum() / mean : -1;
}

/// Fills one cell. @return asymmetry_of its two values.
double fill_cell(const RglMaterial& material, const DirectionPair& centre, std::size_t cell, MeasuredTable& table) {
  const auto [wi, wo] = centre;
  if (!(wi.z() > 0 && wo.z() > 0)) return -1;
  const Rgb forward = material.f_one_way(wo, wi);
  const Rgb backward = material.f_one_way(wi, wo);
  const Rgb mean = 0.5 * (forward + backward);
  for (std::size_t channel = 0; channel < 3; ++channel) table.values[channel][cell] = mean[static_cast<int>(channel)];
  table.valid[cell] = 1;
  return asymmetry_of(forward, backward);
}

}  // namespace

MeasuredTable resample(const RglMaterial& material, std::string name) {
  if (!material.isotropic()) throw std::invalid_argument("resample: the material '" + name + "' must be isotropic");
  MeasuredTable table;
  table.name = std::move(name);
  table.provenance = Provenance::measured;
  table.valid.assign(Grid::cells, 0);
  for (std::vector<double>& plane : table.values) plane.assign(Grid::cells, 0.0);

  std::vector<double> asymmetry(Grid::cells);
  tbb::parallel_for(0, Grid::theta_h, [&](int i) {
    for (int j = 0; j < Grid::theta_d; ++j) {
      for (int k = 0; k < Grid::phi_d; ++k) {
        const auto cell = static_cast<std::size_t>(Grid::index(i, j, k));
        asymmetry[cell] = fill_cell(material, cell_directions(i, j, k), cell, table);
      }
    }
  });
  std::erase_if(asymmetry, [](double ratio) { return ratio < 0; });
  table.report.negative_share = material.negative_share();
  table.report.median_asymmetry = median(std::move(asymmetry));
  table.report.mirror_asymmetry = mirror_asymmetry(table);
  return table;
}

AnisotropicTable resample_anisotropic(const std::shared_ptr<const RglMaterial>& material, std::string name,
                                      AnisotropicGrid grid) {
  const RglBrdf brdf(material);
  if (material->folds() > 1) grid.turns = std::lcm(grid.turns, 2);
  if (material->folds() == 4) grid.mirrored = true;
  AnisotropicTable table = fold_symmetric(tabulate_anisotropic(brdf, std::move(name), Provenance::measured, grid));
  table.report.negative_share = material->negative_share();
  table.report.median_asymmetry = median_asymmetry(*material);
  return table;
}

double median_asymmetry(const RglMaterial& material) {
  std::vector<double> asymmetry;
  for (int i = 0; i < kProbeGrid.theta_h; ++i) {
    for (int m = 0; m < (material.isotropic() ? 1 : kProbeGrid.phi_h); ++m) {
      for (int j = 0; j < kProbeGrid.theta_d; ++j) {
        for (int k = 0; k < kProbeGrid.phi_d; ++k) {
          const auto [wi, wo] = directions4(kProbeGrid.centre(i, m, j, k));
          if (!(wi.z() > 0 && wo.z() > 0)) continue;
          const double ratio = asymmetry_of(material.f_one_way(wo, wi), material.f_one_way(wi, wo));
          if (ratio >= 0) asymmetry.push_back(ratio);
        }
      }
    }
  }
  return median(std::move(asymmetry));
}

RglBrdf::RglBrdf(std::shared_ptr<const RglMaterial> material) : material_(std::move(material)) {
  if (!material_) throw std::invalid_argument("RglBrdf: no material given");
}

Rgb RglBrdf::eval(const Vec3& wo, const Vec3& wi) const {
  if (!(wo.z() > 0 && wi.z() > 0)) return Rgb::Zero();
  return 0.5 * (material_->f_one_way(wo, wi) + material_->f_one_way(wi, wo));
}

}  // namespace sklar::brdf
