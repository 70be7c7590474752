#pragma once
/// The abstract copula: immutable, batch first. Every public call checks its arguments once, then makes one virtual
/// call.

#include <memory>
#include <span>

#include "copula/random.hpp"
#include "copula/reflection.hpp"
#include "copula/types.hpp"

namespace sklar {

/// A copula C on [0,1]^d. Accuracy of every quantity: see Archimedean (relative error of log density <= 1e-13) and
/// Mixture.
/// Points of the boundary are valid input. A coordinate 0 or 1 stands for the limit eps or 1 - eps, eps -> 0, the same
/// eps in all coordinates: it matters in the corners, where densities and conditionals depend on the direction of
/// approach (log_pdf may be -inf or inf there). A last coordinate or p of 0 or 1 gives 0 or 1 itself in h and h_inv.
/// A row with NaN gives NaN; other rows are never affected.
class Copula {
 public:
  virtual ~Copula() = default;

  [[nodiscard]] int dim() const noexcept { return dim_; }

  /// Natural log of the density. @param u n x d in [0,1]. @return n values, -inf where the density is 0.
  /// @throws std::invalid_argument (columns), std::domain_error (u outside [0,1]); so do all calls below.
  [[nodiscard]] Column log_pdf(const PointsRef& u) const;
  [[nodiscard]] Column pdf(const PointsRef& u) const;

  /// The same for one point, without heap allocation up to dimension 16. @param u d values in [0,1] or NaN; unchecked.
  [[nodiscard]] double log_pdf_at(std::span<const double> u) const;

  /// C(u) and its natural log. @param u n x d in [0,1].
  [[nodiscard]] Column log_cdf(const PointsRef& u) const;
  [[nodiscard]] Column cdf(const PointsRef& u) const;

  /// Conditional cdf C(u_k | u_1..u_{k-1}) and its complement, each without cancellation.
  /// @param u n x k in [0,1], 1 <= k <= d. For k = 1 the answer is u_1 (1 - u_1).
  [[nodiscard]] Column h(const PointsRef& u) const;
  [[nodiscard]] Column h_upper(const PointsRef& u) const;

  /// Inverse of h in its last argument: the v with h(u_1..u_{k-1}, v) = p, and 1 - v without cancellation.
  /// @param u n x k in [0,1]; the last column holds p.
  [[nodiscard]] Column h_inv(const PointsRef& u) const;
  [[nodiscard]] Column h_inv_upper(const PointsRef& u) const;

  /// Rosenblatt transform: column k becomes h(u_1..u_k). @param u n x d.
  [[nodiscard]] Points rosenblatt(const PointsRef& u) const;

  /// Uniforms to points of the copula, the leading coordinates given. Plain sampling is g = 0.
  /// @param w n x (d-g) uniforms; @param given n x g, or 1 x g for the same in every row, g < d. @return n x d points.
  [[nodiscard]] Points inverse_rosenblatt(const PointsRef& w, const PointsRef& given = Points(1, 0)) const;

  /// n points by inverse_rosenblatt from the generator's uniforms. @param n >= 1. @param given 1 x g.
  [[nodiscard]] Points sample(Index n, Rng& rng, const PointsRef& given = Points(1, 0)) const;

 protected:
  /// @throws std::invalid_argument unless dim >= 2.
  explicit Copula(int dim);

  enum class Tail { lower, upper };  ///< the quantity itself or its complement

 private:
  friend class Rotated;
  friend class Mixture;

  // What the public calls of these names give for this copula rotated: with U its coordinates, that of the 1 - U_i for
  // the reflected i and the other U_i, as exact as without rotation. u holds coordinates of the rotated copula.
  // log_pdf_into: of the first u.cols() coordinates, 1 to dim().
  virtual void log_pdf_into(const PointsRef& u, const Reflection& reflection, ColumnOut out) const = 0;
  virtual void log_cdf_into(const PointsRef& u, const Reflection& reflection, ColumnOut out) const = 0;
  virtual void conditional_into(const PointsRef& u, const Reflection& reflection, Tail tail, ColumnOut out) const = 0;
  virtual void conditional_inverse_into(const PointsRef& u, const Reflection& reflection, Tail tail,
                                        ColumnOut out) const = 0;

  int dim_;
};

using CopulaPtr = std::shared_ptr<const Copula>;

}  // namespace sklar
