#include "copula/inference/score.hpp"

#include <cmath>

#include "copula/inference/chunks.hpp"

namespace sklar {
namespace {

constexpr double kStep = 6e-6;  // relative, the cube root of the rounding error
constexpr double kLeast = 1e-3;

}  // namespace

SampleScore::SampleScore(const FamilyInfo& family, const PointsRef& u, const ColumnRef& weights,
                         const Chunking& chunking)
    : family_(family), u_(u), weights_(weights), chunking_(chunking) {
  const int dim = static_cast<int>(u.cols());
  if (!family.psi.empty() && dim <= symbolic::kMaxDimension) gradient_.emplace(family, dim);
}

std::vector<double> SampleScore::operator()(const Theta& theta) const {
  if (!gradient_) return by_differences(theta);
  const auto k = static_cast<Index>(theta.size());
  const Eigen::ArrayXd sum =
      sum_over_chunks(u_.rows(), chunking_, Eigen::ArrayXd(Eigen::ArrayXd::Zero(k)), [&](Index first, Index count) {
        const Points rows = (*gradient_)(theta, u_.middleRows(first, count));
        Eigen::ArrayXd part = Eigen::ArrayXd::Zero(k);
        for (Index i = 0; i < count; ++i) {
          const double weight = weights_.size() > 0 ? weights_[first + i] : 1.0;
          if (weight > 0) part += weight * rows.row(i).transpose();
        }
        return part;
      });
  return {sum.begin(), sum.end()};
}

std::vector<double> SampleScore::by_differences(const Theta& theta) const {
  const int dim = static_cast<int>(u_.cols());
  const auto likelihood = [&](const Theta& at) {
    return log_likelihood(*family_.make_unchecked(dim, at), u_, weights_, chunking_).or_nothing();
  };
  std::vector<double> score(theta.size());
  for (std::size_t i = 0; i < theta.size(); ++i) {
    const Interval domain = family_.parameters[i].domain(dim);
    const double room = 0.5 * std::min(theta[i] - domain.lowest, domain.highest - theta[i]);
    const double step = std::min(kStep * std::max(std::abs(theta[i]), kLeast), room);
    Theta low = theta, high = theta;
    low[i] -= step;
    high[i] += step;
    score[i] = (likelihood(high) - likelihood(low)) / (high[i] - low[i]);
  }
  return score;
}

}  // namespace sklar
