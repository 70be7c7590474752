#pragma once
/// A density estimated by Gaussian kernels.

#include "copula/inference/marginal.hpp"

namespace sklar {

/// Density sum w_i phi((x - x_i) / h) / (h sum w_i). The support is the whole line: where the data have a bound, mass
/// of the width h lies beyond it, and a margin that ends there (beta, gamma, histogram) is the better choice. cdf has a
/// relative error of 1e-13 in the lower tail, log_pdf too, absolute below 1. O(n) a value; quantile about 15 times
/// that.
class KernelMarginal final : public DensityMarginal {
 public:
  /// @param data n >= 1 finite values. @param bandwidth h, finite and above 0. @param weights n frequencies >= 0, or
  /// none for one each. @throws std::invalid_argument (shapes, all weights zero), std::domain_error naming what is out
  /// of range.
  KernelMarginal(const ColumnRef& data, double bandwidth, const ColumnRef& weights = Column());

  using DensityMarginal::cdf;
  using DensityMarginal::log_pdf;
  using DensityMarginal::quantile;
  [[nodiscard]] double cdf(double x) const override;
  [[nodiscard]] double quantile(double p) const override;  ///< infinite at 0 and 1; relative to |x| + h
  [[nodiscard]] double log_pdf(double x) const override;

  [[nodiscard]] double bandwidth() const noexcept { return bandwidth_; }
  [[nodiscard]] const std::vector<double>& values() const noexcept { return values_; }
  [[nodiscard]] const std::vector<double>& weights() const noexcept { return weights_; }  ///< none: one each

 private:
  [[nodiscard]] double weight(std::size_t i) const { return weights_.empty() ? 1.0 : weights_[i]; }

  /// P(X <= x), or P(X > x), each without cancellation.
  [[nodiscard]] double tail(double x, bool upper) const;

  std::vector<double> values_;
  std::vector<double> weights_;
  double bandwidth_;
  double total_;
};

/// Silverman's rule of thumb (1986, Density Estimation, eq. 3.31): 0.9 min(sd, IQR / 1.34) N^(-1/5), sd with N - 1, the
/// quartiles linear between the data of ranks around 1 + (N-1)/4 and 1 + 3(N-1)/4 (R's bw.nrd0); sd alone where the IQR
/// is 0. @param x n >= 2 finite values. @param weights n frequencies, N their sum, or none for one each.
/// @throws std::invalid_argument where all values are the same or N <= 1, and as KernelMarginal.
[[nodiscard]] double silverman_bandwidth(const ColumnRef& x, const ColumnRef& weights = Column());

}  // namespace sklar
