#include <tbb/parallel_for.h>

#include <cmath>
#include <numbers>

#include "brdf/data/rgl.hpp"
#include "brdf/geometry/coordinates.hpp"

namespace sklar::brdf {
namespace {

const double kCosineFloor = std::cos(87.5 * std::numbers::pi / 180);

/// f_r with wi as the direction known to the file, clamped at 0.
Rgb f_clamped(const RglMaterial& material, const Vec3& wo, const Vec3& wi) {
  return (material.f_cos(wo, wi) / std::max(wo.z(), kCosineFloor)).max(0.0);
}

/// Fills one cell. @return |f(wi,wo) - f(wo,wi)| / mean, channels summed; negative where it has no meaning.
double fill_cell(const RglMaterial& material, const HalfDifference& centre, std::size_t cell, MeasuredTable& table) {
  const auto [wi, wo] = directions(centre);
  if (!(wi.z() > 0 && wo.z() > 0)) return -1;
  const Rgb forward = f_clamped(material, wo, wi);
  const Rgb backward = f_clamped(material, wi, wo);
  const Rgb mean = 0.5 * (forward + backward);
  for (std::size_t channel = 0; channel < 3; ++channel) table.values[channel][cell] = mean[static_cast<int>(channel)];
  table.valid[cell] = 1;
  return mean.sum() > 0 ? (forward - backward).abs().sum() / mean.sum() : -1;
}

}  // namespace

MeasuredTable resample(const RglMaterial& material, std::string name) {
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
        const HalfDifference centre{Grid::theta_h_centre(i), Grid::theta_d_centre(j), Grid::phi_d_centre(k)};
        asymmetry[cell] = fill_cell(material, centre, cell, table);
      }
    }
  });
  std::erase_if(asymmetry, [](double ratio) { return ratio < 0; });
  table.report.negative_share = material.negative_share();
  table.report.median_asymmetry = median(std::move(asymmetry));
  table.report.mirror_asymmetry = mirror_asymmetry(table);
  return table;
}

}  // namespace sklar::brdf
