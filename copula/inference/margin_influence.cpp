#include "copula/inference/margin_influence.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

#include "copula/inference/row_derivatives.hpp"
#include "copula/inference/row_weights.hpp"

namespace sklar {
namespace {

/// Steps of t: the first for slopes; the second, in units of the spread of one row, for curvatures too.
constexpr double kFirstStep = 1e-5;
constexpr double kStep = 1e-3;

std::shared_ptr<const DensityMarginal> moved(const MarginFit& margin, const std::vector<double>& t) {
  std::vector<double> parameters = margin.parameters;
  for (std::size_t a = 0; a < t.size(); ++a) {
    parameters[a] = is_location(margin.spec.kind, a) ? parameters[a] + t[a] : parameters[a] * std::exp(t[a]);
  }
  return density_of(make_margin(margin.spec, parameters));
}

/// The first steps: relative, of a mean to the standard deviation, which is the second parameter.
std::vector<double> first_steps(const MarginFit& margin) {
  std::vector<double> steps(margin.parameters.size(), kFirstStep);
  if (is_location(margin.spec.kind, 0)) steps[0] *= margin.parameters[1];
  return steps;
}

}  // namespace

MarginInfluence margin_influence(const MarginFit& margin, const ColumnRef& x, const ColumnRef& weights) {
  if (margin.spec.kind == MarginKind::empirical) return {.ranks = true};
  const RowWeights rows(weights, x.size());
  const auto log_pdf = [&](const std::vector<double>& t) { return moved(margin, t)->log_pdf(x); };
  const auto cdf = [&](const std::vector<double>& t) { return moved(margin, t)->cdf(x); };
  const std::vector<double> here(margin.parameters.size(), 0.0);
  std::vector<double> step = first_steps(margin);
  const RowDerivatives rough(log_pdf, here, step);
  for (std::size_t a = 0; a < step.size(); ++a) {
    step[a] = kStep * std::sqrt(rows.total() / rows.sum(rough.slope(a).square()));
  }
  const RowDerivatives likelihood(log_pdf, here, step), uniforms(cdf, here, step);
  const auto p = static_cast<Index>(here.size());
  MarginInfluence result{.slope = Eigen::MatrixXd(x.size(), p), .influence = Eigen::MatrixXd(x.size(), p)};
  Eigen::MatrixXd information(p, p);
  for (Index a = 0; a < p; ++a) {
    const auto parameter = static_cast<std::size_t>(a);
    result.slope.col(a) = uniforms.slope(parameter);
    result.influence.col(a) = likelihood.slope(parameter);
    for (Index b = 0; b <= a; ++b) {
      information(a, b) = -rows.sum(likelihood.curvature(parameter, static_cast<std::size_t>(b)));
      information(b, a) = information(a, b);
    }
  }
  const Eigen::LLT<Eigen::MatrixXd> factor(information);
  if (information.allFinite() && factor.info() == Eigen::Success) {
    result.influence = factor.solve(result.influence.transpose()).transpose().eval();
  } else {
    result.influence.setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  return result;
}

}  // namespace sklar
