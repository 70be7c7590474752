#pragma once
/// Margins: one-dimensional distributions. Every margin has a cdf and a quantile; one with a density is a
/// DensityMarginal, so that what needs a density asks for it by type. Single calls take and give NaN for NaN.

#include <vector>

#include "copula/types.hpp"

namespace sklar {

class Marginal {
 public:
  virtual ~Marginal() = default;

  /// P(X <= x).
  [[nodiscard]] virtual double cdf(double x) const = 0;

  /// The smallest x with cdf(x) >= p, within the support. Precondition: p in [0,1] or NaN.
  [[nodiscard]] virtual double quantile(double p) const = 0;

  [[nodiscard]] Column cdf(const ColumnRef& x) const;

  /// @throws std::domain_error naming the first p outside [0,1].
  [[nodiscard]] Column quantile(const ColumnRef& p) const;
};

/// A margin that has a density.
class DensityMarginal : public Marginal {
 public:
  /// Natural log of the density; -inf where it is 0.
  [[nodiscard]] virtual double log_pdf(double x) const = 0;
  [[nodiscard]] Column log_pdf(const ColumnRef& x) const;
};

/// Constant density within each bin, so a piecewise-linear cdf. Bins of mass 0 are allowed: there the density is 0, the
/// cdf flat, and quantile gives the lower end of the flat piece. quantile(0) is the lower end of the support.
class HistogramMarginal final : public DensityMarginal {
 public:
  /// @param edges  m+1 finite, strictly increasing. @param masses m values >= 0, not all 0, of any scale.
  /// @throws std::invalid_argument (counts, all masses 0), std::domain_error naming the first edge or mass at fault.
  HistogramMarginal(std::vector<double> edges, std::vector<double> masses);

  using DensityMarginal::cdf;
  using DensityMarginal::log_pdf;
  using DensityMarginal::quantile;
  [[nodiscard]] double cdf(double x) const override;
  [[nodiscard]] double quantile(double p) const override;
  [[nodiscard]] double log_pdf(double x) const override;  ///< at an inner edge: the density of the bin above

  [[nodiscard]] const std::vector<double>& edges() const noexcept { return edges_; }
  [[nodiscard]] const std::vector<double>& masses() const noexcept { return masses_; }  ///< as given

 private:
  [[nodiscard]] std::size_t bin(double x) const;

  std::vector<double> edges_;
  std::vector<double> masses_;
  std::vector<double> cumulative_;   ///< m+1, the cdf at the edges, from exactly 0 to exactly 1
  std::vector<double> log_density_;  ///< m, from the masses: a difference of the cdf would lose small ones
};

/// The distribution of n data values of frequencies w_i, N = sum w_i: cdf = rank / (N+1), so that it is inside (0,1) at
/// the data and agrees with pseudo_observations there; constant between two values, N/(N+1) from the largest one on. It
/// has no density.
class EmpiricalMarginal final : public Marginal {
 public:
  /// @param data n >= 1 finite values in any order. @param weights n frequencies >= 0, or none for one each.
  /// @throws std::invalid_argument (no values, shapes, all weights zero), std::domain_error naming the first value that
  /// is not finite or weight out of range.
  explicit EmpiricalMarginal(const ColumnRef& data, const ColumnRef& weights = Column());

  using Marginal::cdf;
  using Marginal::quantile;
  [[nodiscard]] double cdf(double x) const override;       ///< at tied data: their mean rank
  [[nodiscard]] double quantile(double p) const override;  ///< the data value of rank ceil(p (N+1)), at most N

  /// The pseudo-observation of a value that need not be among the data, strictly inside (0,1): at data cdf(x),
  /// elsewhere the middle between the values of the cdf at both sides, (N_below + 1/2) / (N+1).
  [[nodiscard]] double pseudo_observation(double x) const;

  [[nodiscard]] const std::vector<double>& sorted() const noexcept { return sorted_; }
  [[nodiscard]] const std::vector<double>& weights() const noexcept { return weights_; }  ///< of sorted(), none: 1 each

 private:
  struct Ranks {
    double below;   ///< sum of the weights of smaller values
    double tied;    ///< of equal ones
    bool at_value;  ///< whether there are equal ones
  };
  [[nodiscard]] Ranks ranks(double x) const;
  [[nodiscard]] double total() const { return cumulative_.back(); }

  std::vector<double> sorted_;
  std::vector<double> weights_;
  std::vector<double> cumulative_;  ///< n+1 sums of the weights, from 0 to N
};

}  // namespace sklar
