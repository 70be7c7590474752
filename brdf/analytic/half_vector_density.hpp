#pragma once
/// Densities of facet normals that do not depend on azimuth, and the area that such facets show to a direction. Their
/// argument is v = 1 - cos(theta_h), whose differential is that of solid angle over 2 pi.

#include <memory>
#include <vector>

#include "brdf/brdf.hpp"

namespace sklar::brdf {

class HalfVectorDensity {
 public:
  virtual ~HalfVectorDensity() = default;

  /// p per solid angle, with integral 1, finite. @param versine v, in [0,1] to rounding.
  [[nodiscard]] virtual double operator()(double versine) const = 0;

  /// v of a draw from p. @param uniform in (0,1].
  [[nodiscard]] virtual double draw(double uniform) const = 0;

  /// Values of v, rising from 0 to 1, between which p hardly differs from a line: where to integrate it.
  [[nodiscard]] virtual std::vector<double> nodes() const = 0;

  /// Size in bytes of what the evaluation needs.
  [[nodiscard]] virtual std::size_t bytes() const = 0;
};

/// Linear in v between given values, so that integrals and draws are closed.
class TabulatedDensity final : public HalfVectorDensity {
 public:
  /// @param theta nodes, radians, rising from 0 to pi/2, two or more. @param density at the nodes, >= 0, in any unit.
  /// @throws std::invalid_argument unless there are as many of both and the nodes rise so; std::domain_error for a
  /// density that is negative, not finite, or 0 everywhere.
  TabulatedDensity(const std::vector<double>& theta, const std::vector<double>& density);

  [[nodiscard]] double operator()(double versine) const override;
  [[nodiscard]] double draw(double uniform) const override;
  [[nodiscard]] std::vector<double> nodes() const override { return versine_; }
  [[nodiscard]] std::size_t bytes() const override {
    return (versine_.size() + density_.size() + below_.size()) * sizeof(double);
  }

 private:
  std::vector<double> versine_, density_;
  std::vector<double> below_;  ///< share of p below each node
};

/// The mean area that facets of unit area with normals of density p show to a direction k,
///
///     g(k) = integral of max(0, h.k) p(h) dh = integral of 2 I(a, b) p dv,
///     a = cos(theta_h) cos(k), b = sin(theta_h) sin(k), I = pi a where a >= b, else a acos(-a / b) + sqrt(b^2 - a^2)
///
/// (Ashikhmin, Premoze and Shirley 2000, "A Microfacet-based BRDF Generator"), tabulated against the cube root of
/// cos(k), since it bends near grazing as sharply as p is narrow.
class FacetArea {
 public:
  /// Costs 256 evaluations of p and I a node of the density.
  explicit FacetArea(const HalfVectorDensity& density);

  /// g, at least g(n) cos(k); within 1e-3 of its value for a p that turns within 3 degrees.
  [[nodiscard]] double operator()(double cosine) const;

  /// g of the normal, the mean of cos(theta_h).
  [[nodiscard]] double of_normal() const { return values_.back(); }

  [[nodiscard]] std::size_t bytes() const { return values_.size() * sizeof(double); }

 private:
  std::vector<double> values_;  ///< at cosines (n / (size - 1))^3
};

}  // namespace sklar::brdf
