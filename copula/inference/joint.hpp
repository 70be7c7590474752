#pragma once
/// Sklar's theorem: margins and a copula make a joint distribution, H(x) = C(F_1(x_1), .., F_d(x_d)) (paper Eq. 2).

#include <memory>
#include <vector>

#include "copula/copula.hpp"
#include "copula/inference/marginal.hpp"

namespace sklar {

/// Margins of any kind. Every call takes x with any value (a row with NaN gives NaN) and throws std::invalid_argument
/// for a wrong shape.
class JointDistribution {
 public:
  /// @throws std::invalid_argument unless there is one margin a dimension of the copula.
  JointDistribution(std::vector<std::shared_ptr<const Marginal>> margins, CopulaPtr copula);

  [[nodiscard]] int dim() const noexcept { return copula_->dim(); }
  [[nodiscard]] const Marginal& margin(int i) const { return *margins_.at(static_cast<std::size_t>(i)); }
  [[nodiscard]] const Copula& copula() const noexcept { return *copula_; }

  /// F_i(x_i) of the leading k coordinates. @param x n x k, 1 <= k <= d.
  [[nodiscard]] Points to_uniforms(const PointsRef& x) const;

  /// P(X_1 <= x_1, .., X_d <= x_d). @param x n x d.
  [[nodiscard]] Column cdf(const PointsRef& x) const;

  /// P(X_k <= x_k | X_1 = x_1, .., X_{k-1} = x_{k-1}). @param x n x k, 1 <= k <= d.
  [[nodiscard]] Column conditional_cdf(const PointsRef& x) const;

  /// Inverse of conditional_cdf in the last coordinate. @param x n x k; the last column holds p in [0,1].
  [[nodiscard]] Column conditional_quantile(const PointsRef& x) const;

  /// Uniforms to points, the leading g < d coordinates given. @param w n x (d-g). @param given n x g or 1 x g values of
  /// X. @return n x d; the given coordinates unchanged.
  [[nodiscard]] Points inverse_rosenblatt(const PointsRef& w, const PointsRef& given = Points(1, 0)) const;

  /// n points by inverse_rosenblatt from the generator's uniforms. @param n >= 1. @param given 1 x g.
  [[nodiscard]] Points sample(Index n, Rng& rng, const PointsRef& given = Points(1, 0)) const;

 private:
  /// Points of the copula to points of X, keeping the given leading coordinates.
  [[nodiscard]] Points values(const Points& u, const PointsRef& given) const;

  std::vector<std::shared_ptr<const Marginal>> margins_;
  CopulaPtr copula_;
};

/// Margins that all have a density, so that the joint distribution has one.
class JointDensity final : public JointDistribution {
 public:
  /// @throws as JointDistribution does.
  JointDensity(std::vector<std::shared_ptr<const DensityMarginal>> margins, CopulaPtr copula);

  /// Natural log of c(F(x)) prod f_i(x_i), -inf outside the support. @param x n x d.
  [[nodiscard]] Column log_pdf(const PointsRef& x) const;

 private:
  std::vector<std::shared_ptr<const DensityMarginal>> densities_;
};

}  // namespace sklar
