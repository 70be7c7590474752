#pragma once
/// The abstract copula: immutable, batch first. Every public call checks its arguments once, then makes one virtual
/// call.

#include <memory>
#include <span>
#include <vector>

#include "copula/accuracy.hpp"
#include "copula/big_float.hpp"
#include "copula/kernels.hpp"
#include "copula/random.hpp"
#include "copula/reflection.hpp"
#include "copula/types.hpp"

namespace sklar {

/// What may be asked for to any number of digits; see the functions of Copula of these names.
enum class Quantity { log_pdf, log_cdf, h, h_upper, h_inv, h_inv_upper };

/// How points are drawn. conditional: Copula::sample. frailty: psi(E_i / V) with exponential E_i, one frailty V a
/// point, the fastest; positive dependence only. radial: psi(R S_i), S uniform on the simplex, any dependence (McNeil
/// and Neslehova 2009, Theorem 2). The last two are those of the generator of an Archimedean copula: a rotated copula
/// reflects such a point, a mixture draws it from one of its components.
enum class Route { conditional, frailty, radial };

/// A copula C on [0,1]^d. Accuracy of every quantity: see Archimedean (relative error of log density <= 1e-13) and
/// Mixture.
/// Points of the boundary are valid input. A coordinate 0 or 1 stands for the limit eps or 1 - eps, eps -> 0, the same
/// eps in all coordinates: it matters in the corners, where densities and conditionals depend on the direction of
/// approach (log_pdf may be -inf or inf there). A last coordinate or p of 0 or 1 gives 0 or 1 itself in h and h_inv.
/// Where an Accuracy may be given, fast keeps kFastTolerance only.
/// A row with NaN gives NaN; other rows are never affected. Large batches are computed on all threads of oneTBB's
/// arena, with the same result for any number of them.
class Copula {
 public:
  virtual ~Copula() = default;

  /// d, 2 or more.
  [[nodiscard]] int dim() const noexcept { return dim_; }

  /// Natural log of the density. @param u n x d in [0,1]. @return n values, -inf where the density is 0.
  /// @throws std::invalid_argument (columns), std::domain_error (u outside [0,1]); so do all calls below.
  [[nodiscard]] Column log_pdf(const PointsRef& u) const { return log_pdf(u, Accuracy::standard); }
  [[nodiscard]] Column log_pdf(const PointsRef& u, Accuracy accuracy) const;
  [[nodiscard]] Column pdf(const PointsRef& u) const;

  /// The same for one point, without heap allocation up to dimension 16. @param u d values in [0,1] or NaN; unchecked.
  [[nodiscard]] double log_pdf_at(std::span<const double> u) const;

  /// C(u) and its natural log. @param u n x d in [0,1].
  [[nodiscard]] Column log_cdf(const PointsRef& u) const;
  [[nodiscard]] Column cdf(const PointsRef& u) const;

  /// Conditional cdf C(u_k | u_1..u_{k-1}) and its complement, each without cancellation.
  /// @param u n x k in [0,1], 1 <= k <= d. For k = 1 the answer is u_1 (1 - u_1).
  [[nodiscard]] Column h(const PointsRef& u) const { return h(u, Accuracy::standard); }
  [[nodiscard]] Column h(const PointsRef& u, Accuracy accuracy) const;
  [[nodiscard]] Column h_upper(const PointsRef& u) const { return h_upper(u, Accuracy::standard); }
  [[nodiscard]] Column h_upper(const PointsRef& u, Accuracy accuracy) const;

  /// Natural log of the density of u_k given u_1..u_{k-1}, the slope of h in its last argument; 0 for k = 1.
  /// @param u n x k in [0,1], 1 <= k <= d. @return NaN where the density of the given coordinates is 0 or infinite.
  [[nodiscard]] Column log_conditional_pdf(const PointsRef& u) const;

  /// Inverse of h in its last argument: the v with h(u_1..u_{k-1}, v) = p, and 1 - v without cancellation.
  /// @param u n x k in [0,1]; the last column holds p.
  [[nodiscard]] Column h_inv(const PointsRef& u) const { return h_inv(u, Accuracy::standard); }
  [[nodiscard]] Column h_inv(const PointsRef& u, Accuracy accuracy) const;
  [[nodiscard]] Column h_inv_upper(const PointsRef& u) const { return h_inv_upper(u, Accuracy::standard); }
  [[nodiscard]] Column h_inv_upper(const PointsRef& u, Accuracy accuracy) const;

  /// Rosenblatt transform: column k becomes h(u_1..u_k). @param u n x d.
  [[nodiscard]] Points rosenblatt(const PointsRef& u) const;

  /// Uniforms to points of the copula, the leading coordinates given. Plain sampling is g = 0.
  /// @param w n x (d-g) uniforms; @param given n x g, or 1 x g for the same in every row, g < d. @return n x d points.
  [[nodiscard]] Points inverse_rosenblatt(const PointsRef& w, const PointsRef& given = Points(1, 0)) const;

  /// n points by inverse_rosenblatt from the generator's uniforms. @param n >= 1. @param given 1 x g.
  [[nodiscard]] Points sample(Index n, Rng& rng, const PointsRef& given = Points(1, 0)) const;

  /// n points by a route. The routes draw different points of the same distribution. @param n >= 1.
  /// @throws std::domain_error for the frailty route where has_frailty() is false.
  [[nodiscard]] Points sample_by(Route route, Index n, Rng& rng) const;

  /// Whether every generator in it knows the distribution that it is the Laplace transform of.
  [[nodiscard]] virtual bool has_frailty() const = 0;

  /// A quantity with so many significant decimal digits right. Doubles are taken as the exact numbers they are.
  /// @param u as for the function of that name. @param digits 1 to kMostDigits.
  /// @return n numbers of more bits than digits need; NaN for a row with NaN, and where 2240 digits more do not do (a
  /// value that is 0 by cancellation). @throws as the function of that name; std::invalid_argument for digits.
  [[nodiscard]] std::vector<BigFloat> exact(Quantity quantity, const PointsRef& u, int digits) const;

  static constexpr int kMostDigits = 10'000;  ///< of exact

 protected:
  /// @throws std::invalid_argument unless dim >= 2.
  explicit Copula(int dim);

  /// The quantity with the accuracy of the public calls. Precondition: u as these take it.
  void standard_into(Quantity quantity, const PointsRef& u, const ColumnOut& out) const;

  /// @throws std::invalid_argument for a number of digits that exact does not give.
  static void require_digits(int digits);

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
  [[nodiscard]] virtual BigFloat exact_row(Quantity quantity, std::span<const BigFloat> u, const Reflection& reflection,
                                           int digits) const = 0;

  /// One point of this copula rotated. Precondition: not the conditional route; has_frailty() for that of the frailty.
  virtual void draw(Route route, const Reflection& reflection, Rng& rng, std::span<double> u) const = 0;

  // What vector kernels answer with this accuracy, NaN for the rows that they leave; u may be outside the unit cube.
  [[nodiscard]] virtual Answered quick_into(Quantity quantity, Accuracy accuracy, const PointsRef& u,
                                            double* out) const;

  // A public call of this name. Precondition: the number of columns.
  [[nodiscard]] Column evaluate(const char* function, Quantity quantity, const PointsRef& u, Accuracy accuracy) const;
  // Answers the rows whose value is NaN, unless one of them is outside the unit cube: false.
  [[nodiscard]] bool fill_left(Quantity quantity, const PointsRef& u, ColumnOut out) const;

  // Makes uniforms, all but the leftmost fixed columns, points of the copula.
  void invert(Points& u, Index fixed) const;

  int dim_;
};

/// How copulas are held and shared.
using CopulaPtr = std::shared_ptr<const Copula>;

}  // namespace sklar
