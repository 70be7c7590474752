#pragma once
/// Margins of few parameters: normal, gamma, beta. cdf and quantile keep a relative error of 1e-13 in both tails,
/// log_pdf the same, absolute below 1, where long double has 64 bits; a quantile relative to the larger of its two
/// terms where it is a sum (mean + sd z; an end + width y). Shapes beyond 1e5 lose digits in proportion. The
/// computations are those of Boost.Math in long double.

#include <array>

#include "copula/inference/marginal.hpp"

namespace sklar {

/// Normal with mean and standard deviation.
class NormalMarginal final : public DensityMarginal {
 public:
  /// @throws std::domain_error unless mean is finite and sd finite and above 0.
  NormalMarginal(double mean, double sd);

  using DensityMarginal::cdf;
  using DensityMarginal::log_pdf;
  using DensityMarginal::quantile;
  [[nodiscard]] double cdf(double x) const override;
  [[nodiscard]] double quantile(double p) const override;  ///< infinite at 0 and 1
  [[nodiscard]] double log_pdf(double x) const override;

  [[nodiscard]] std::array<double, 2> parameters() const noexcept { return {mean_, sd_}; }

 private:
  double mean_, sd_;
};

/// Density x^(shape-1) exp(-x/scale) / (scale^shape Gamma(shape)) on x > 0.
class GammaMarginal final : public DensityMarginal {
 public:
  /// @throws std::domain_error unless both are finite and above 0.
  GammaMarginal(double shape, double scale);

  using DensityMarginal::cdf;
  using DensityMarginal::log_pdf;
  using DensityMarginal::quantile;
  [[nodiscard]] double cdf(double x) const override;
  [[nodiscard]] double quantile(double p) const override;  ///< infinite at 1
  [[nodiscard]] double log_pdf(double x) const override;   ///< at 0 the limit

  [[nodiscard]] std::array<double, 2> parameters() const noexcept { return {shape_, scale_}; }

 private:
  double shape_, scale_;
  long double log_constant_;
};

/// Density y^(a-1) (1-y)^(b-1) / (B(a,b) width) on lowest < x < highest, y = (x - lowest) / width.
class BetaMarginal final : public DensityMarginal {
 public:
  /// @throws std::domain_error unless a and b are finite and above 0, and the ends finite and rising.
  BetaMarginal(double a, double b, double lowest = 0, double highest = 1);

  using DensityMarginal::cdf;
  using DensityMarginal::log_pdf;
  using DensityMarginal::quantile;
  [[nodiscard]] double cdf(double x) const override;
  [[nodiscard]] double quantile(double p) const override;
  [[nodiscard]] double log_pdf(double x) const override;  ///< at the ends the limits

  [[nodiscard]] std::array<double, 2> parameters() const noexcept { return {a_, b_}; }
  [[nodiscard]] std::array<double, 2> support() const noexcept { return {lowest_, highest_}; }

 private:
  double a_, b_, lowest_, highest_;
  long double width_, log_constant_;
};

}  // namespace sklar
