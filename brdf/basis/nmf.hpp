#pragma once
/// Non-negative factors over the outgoing direction and the half vector, with their sampler.
///
///     f_r(wi, wo) cos_i = sum_j F_j(wo) sum_k u_jk(theta_h) v_jk(phi_h)
///
/// Lawrence, Rusinkiewicz and Ramamoorthi 2004, "Efficient BRDF Importance Sampling Using a Factored Representation":
/// f_r cos_i as a matrix over wo and h, factored twice (section 4). For isotropic data F is a function of
/// theta_o and phi_h counts from the azimuth of wo; here it is folded to [0, pi], the mean of both sides. F has three
/// channels, u and v are shared. Not reciprocal. f_r divides by max(cos_i, cos 89 deg).
///
/// Fitted to f_r cos_i on the nodes by the multiplicative updates of Lee and Seung 2001 that lessen the generalised
/// Kullback-Leibler divergence, each node above the horizon counting once: F against functions of h, these against
/// u v, then all factors together, which the paper does not do.
///
/// Draws: a term in proportion to the luminance of F(wo) times the integral of u v over h; theta_h from u,
/// phi_h from v; wi mirrors wo at h, with density p(h) / (4 wo.h). Between nodes p takes the mean of both for u and for
/// v, so that it is what is drawn to rounding. Draws below the horizon are lost; a black F draws the cosine hemisphere.

#include "brdf/basis/half_array.hpp"
#include "brdf/basis/info.hpp"
#include "brdf/data/interpolation.hpp"

namespace sklar::brdf {

/// Nodes: theta_o = a 89 deg / (n - 1); theta_h = (b / (n - 1))^2 90 deg; phi_h = c 180 deg / (n - 1).
struct NmfNodes {
  int theta_o = 2, theta_h = 2, phi_h = 2;  ///< each at least 2
};

class Nmf final : public Brdf {
 public:
  /// A term of the inner factorisation, over the half vector.
  struct Inner {
    HalfArray u;  ///< theta_h nodes, >= 0
    HalfArray v;  ///< phi_h nodes, >= 0
  };
  /// A term of the outer factorisation, over theta_o and the half vector.
  struct Outer {
    HalfArray f;  ///< 3 theta_o nodes, channel by channel, >= 0
    std::vector<Inner> inner;
  };

  /// @throws std::invalid_argument if a factor is not sized as the nodes say or has a negative number.
  Nmf(const NmfNodes& nodes, std::vector<Outer> terms);

  using Brdf::eval;
  [[nodiscard]] Rgb eval(const Vec3& wo, const Vec3& wi) const override;
  [[nodiscard]] double pdf(const Vec3& wo, const Vec3& wi) const override;
  [[nodiscard]] Traits traits() const override { return {.reciprocal = false}; }

  /// The factors, two bytes for each number of nodes, and for the sampler one double a term.
  [[nodiscard]] std::size_t bytes() const override { return bytes_; }

 protected:
  [[nodiscard]] Vec3 sample_direction(const Vec3& wo, const Vec2& uniforms) const override;

 private:
  /// Luminance of F_j(wo) times the integral of u v over the half vectors, summed over the terms.
  [[nodiscard]] double total_mass(const Between& theta_o) const;
  [[nodiscard]] Rgb outer_value(const Outer& outer, const Between& theta_o) const;
  [[nodiscard]] Vec3 draw_half(const Inner& inner, const Vec3& wo, const Vec2& uniforms) const;

  NmfNodes nodes_;
  std::vector<Outer> terms_;
  std::vector<double> mass_;  ///< of each inner term in order
  std::size_t bytes_ = 0;
};

namespace basis::nmf {

[[nodiscard]] BasisInfo info();

}  // namespace basis::nmf
}  // namespace sklar::brdf
