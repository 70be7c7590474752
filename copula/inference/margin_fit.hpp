#pragma once
/// Margins fitted to data: by ranks, by kernels, or by maximum likelihood in the parameters of a distribution.

#include <memory>
#include <string_view>
#include <variant>
#include <vector>

#include "copula/family.hpp"
#include "copula/inference/kernel_marginal.hpp"
#include "copula/inference/marginal.hpp"
#include "copula/inference/parametric_marginal.hpp"

namespace sklar {

/// Every margin that a model can store.
using StoredMarginal =
    std::variant<HistogramMarginal, EmpiricalMarginal, KernelMarginal, NormalMarginal, GammaMarginal, BetaMarginal>;

/// The margin behind the common interfaces; density_of is null for one without a density.
[[nodiscard]] std::shared_ptr<const Marginal> share(const StoredMarginal& margin);
[[nodiscard]] std::shared_ptr<const DensityMarginal> density_of(const StoredMarginal& margin);

/// What a margin is fitted as.
enum class MarginKind { empirical, kernel, normal, gamma, beta };

[[nodiscard]] std::string_view to_text(MarginKind kind);  ///< "empirical", ...

/// A kind of margin with its support.
struct MarginSpec {
  MarginKind kind = MarginKind::empirical;
  double lowest = 0;  ///< of the support of a beta margin
  double highest = 1;
};

/// Where the data of such a margin must be.
[[nodiscard]] Interval support(const MarginSpec& spec);

/// "mean" and "sd", "shape" and "scale", "a" and "b", "bandwidth", or none.
[[nodiscard]] std::vector<std::string_view> parameter_names(MarginKind kind);

/// Whether the margin has parameters that are estimated by maximum likelihood: normal, gamma and beta.
[[nodiscard]] bool is_parametric(MarginKind kind);

/// Whether the parameter can have any value; all others are positive.
[[nodiscard]] bool is_location(MarginKind kind, std::size_t parameter);

/// The margin with these parameters. Precondition: is_parametric. @throws std::domain_error as its constructor.
[[nodiscard]] StoredMarginal make_margin(const MarginSpec& spec, const std::vector<double>& parameters);

struct MarginFit {
  MarginSpec spec;
  StoredMarginal margin;
  std::vector<double> parameters;      ///< in the order of parameter_names
  std::vector<double> standard_error;  ///< from the observed information; NaN for a bandwidth
  double log_likelihood;               ///< sum w_i log f(x_i); NaN for an empirical margin, which has no density
};

/// Fits the margin of one column. Frequencies w_i count a row of weight k as k rows, N is their sum. normal: mean and
/// root mean square deviation (over N). gamma: the root of log k - psi(k) = log mean(x) - mean(log x), scale = mean /
/// k. beta: Newton's method on the concave likelihood of a and b, the support being given. kernel: silverman_bandwidth.
/// @param x n >= 2 finite values inside support(spec). @param weights n, or none for one each.
/// @throws std::invalid_argument (shapes, all values the same but for an empirical margin), std::domain_error naming
/// the first value or weight out of range.
[[nodiscard]] MarginFit fit_margin(const MarginSpec& spec, const ColumnRef& x, const ColumnRef& weights = Column());

}  // namespace sklar
