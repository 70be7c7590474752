#include "brdf/basis/spherical_harmonics.hpp"

#include <cmath>
#include <numbers>

namespace sklar::brdf {
namespace {

constexpr double kLeastCosine = 0.017452406437283512819;  ///< cos 89 deg

int count(int order, int m) {
  return order - m + 1;
}

/// Upward recurrence in the degree, stable for all degrees (Press et al. 2007, Numerical Recipes, Eqs. 6.7.9, 6.7.10).
void values(int order, int m, const Vec3& w, double* out) {
  const double sine = std::sqrt(w.x() * w.x() + w.y() * w.y());
  double first = std::sqrt((2 * m + 1) / (4 * std::numbers::pi));
  for (int i = 1; i <= m; ++i) first *= sine * std::sqrt((2 * i - 1) / (2.0 * i));
  out[0] = first;
  double before = 0, norm_before = 0;
  for (int l = m + 1; l <= order; ++l) {
    const double norm = std::sqrt((4.0 * l * l - 1) / (static_cast<double>(l) * l - static_cast<double>(m) * m));
    const double here = out[l - 1 - m];
    out[l - m] = norm * (w.z() * here - (norm_before > 0 ? before / norm_before : 0));
    before = here;
    norm_before = norm;
  }
}

}  // namespace

RadialFunctions SphericalHarmonics::radial() {
  return {count, values};
}

Rgb SphericalHarmonics::eval(const Vec3& wo, const Vec3& wi) const {
  if (!(wo.z() > 0 && wi.z() > 0)) return Rgb::Zero();
  return f_cos_.sum(wi, wo) / std::max(wi.z(), kLeastCosine);
}

namespace basis::spherical_harmonics {

BasisInfo info() {
  constexpr int kMostOrder = 30;
  return {.name = "spherical_harmonics",
          .title = "Spherical harmonics",
          .source = "Westin, Arvo and Torrance 1992, Predicting Reflectance Functions from Complex Surfaces",
          .fit_unchecked = [](const BasisData& data, double max_bytes) -> BrdfPtr {
            const SeriesShape most{SphericalHarmonics::radial(), kMostOrder, false};
            const SeriesShape shape = largest_series("spherical_harmonics", most, max_bytes);
            return std::make_shared<const SphericalHarmonics>(fit_series(data.table, shape, true));
          }};
}

}  // namespace basis::spherical_harmonics
}  // namespace sklar::brdf
