#include "brdf/basis/zernike.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace sklar::brdf {
namespace {

int count(int order, int m) {
  return (order - m) / 2 + 1;
}

/// R_n^m(r) = r^m P_k^(0,m)(2 r^2 - 1), k = (n - m) / 2, by the recurrence of Jacobi's polynomials (Abramowitz and
/// Stegun 1964, 22.7.1).
void values(int order, int m, const Vec3& w, double* out) {
  const double square = (w.x() * w.x() + w.y() * w.y()) / (1 + w.z());  // r^2 = 1 - cos(theta), to its own digits
  const double t = 2 * square - 1;
  const double lead = std::pow(square, 0.5 * m) / std::sqrt(std::numbers::pi * (m == 0 ? 2 : 1));
  double before = 0, now = 1;
  for (int k = 0; k < count(order, m); ++k) {
    out[k] = lead * std::sqrt(m + 2 * k + 1.0) * now;
    const double n = k + 1, b = m, sum = 2 * n + b;
    const double after =
        k == 0 ? 1 + (b + 2) * (t - 1) / 2
               : ((sum - 1) * (sum * (sum - 2) * t - b * b) * now - 2 * (n - 1) * (n + b - 1) * sum * before) /
                     (2 * n * (n + b) * (sum - 2));
    before = now;
    now = after;
  }
}

}  // namespace

Zernike::Zernike(AzimuthalSeries f_r) : f_r_(std::move(f_r)) {
  if (!f_r_.shape().symmetric) throw std::invalid_argument("Zernike: the series must be symmetric");
}

RadialFunctions Zernike::radial() {
  return {count, values};
}

Rgb Zernike::eval(const Vec3& wo, const Vec3& wi) const {
  if (!(wo.z() > 0 && wi.z() > 0)) return Rgb::Zero();
  return f_r_.sum(wi, wo);
}

namespace basis::zernike {

BasisInfo info() {
  return {.name = "zernike",
          .title = "Zernike modes",
          .source =
              "Koenderink, van Doorn and Stavridi 1996, Bidirectional Reflection Distribution Function expressed in "
              "terms of surface scattering modes",
          .fit_unchecked = [](const BasisData& data, double max_bytes) -> BrdfPtr {
            const SeriesShape most{Zernike::radial(), RadialFunctions::kMostOrder, true};
            const SeriesShape shape = largest_series("zernike", most, max_bytes);
            return std::make_shared<const Zernike>(fit_series(data.table, shape, false));
          }};
}

}  // namespace basis::zernike
}  // namespace sklar::brdf
