#pragma once
/// Homomorphic factorisation: a product of functions of one vector each.
///
///     f_r(wi, wo) = p(wo) q(h) p(wi),   per channel
///
/// McCool, Ang and Ahmad 2001, "Homomorphic Factorization of BRDFs for High-Performance Rendering": the
/// logarithm of the product is a sum, which linear least squares fits. For isotropic data p is a function of theta and
/// q one of theta_h. Reciprocal, since p is the same for both directions.
///
/// Fitted to ln max(f_r, 1e-4), each cell counting once, with the paper's penalty on the Laplacian of p and q, small
/// enough to decide only where there are no data. log p stands on nodes in theta, log q on nodes in sqrt(theta_h), both
/// interpolated linearly. The model ends at the resolution of the tables: 1.1 KB.

#include "brdf/basis/half_array.hpp"
#include "brdf/basis/info.hpp"

namespace sklar::brdf {

class Homomorphic final : public Brdf {
 public:
  /// The factors of a channel, in logarithms.
  struct Channel {
    HalfArray log_p;  ///< on nodes k 90 deg / (n - 1) of theta
    HalfArray log_q;  ///< on nodes (k / (n - 1))^2 90 deg of theta_h
  };

  /// @throws std::invalid_argument unless each factor has the same two or more nodes in every channel.
  explicit Homomorphic(std::array<Channel, 3> channels);

  using Brdf::eval;
  [[nodiscard]] Rgb eval(const Vec3& wo, const Vec3& wi) const override;
  [[nodiscard]] Traits traits() const override { return {}; }

  /// The factors.
  [[nodiscard]] std::size_t bytes() const override;

 private:
  std::array<Channel, 3> channels_;
};

namespace basis::homomorphic {

[[nodiscard]] BasisInfo info();

}  // namespace basis::homomorphic
}  // namespace sklar::brdf
