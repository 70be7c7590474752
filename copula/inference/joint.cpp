#include "copula/inference/joint.hpp"

#include <limits>
#include <string>

#include "copula/error.hpp"

namespace sklar {

JointDistribution::JointDistribution(std::vector<std::shared_ptr<const Marginal>> margins, CopulaPtr copula)
    : margins_(std::move(margins)), copula_(std::move(copula)) {
  if (margins_.size() != static_cast<std::size_t>(dim())) {
    throw std::invalid_argument("joint distribution: a copula of dimension " + std::to_string(dim()) + " needs " +
                                std::to_string(dim()) + " margins, got " + std::to_string(margins_.size()));
  }
}

Points JointDistribution::to_uniforms(const PointsRef& x) const {
  require_columns("joint distribution", "x", x.cols(), 1, dim());
  Points u(x.rows(), x.cols());
  for (Index i = 0; i < x.cols(); ++i) u.col(i) = margins_[static_cast<std::size_t>(i)]->cdf(x.col(i));
  return u;
}

Column JointDistribution::cdf(const PointsRef& x) const {
  require_columns("cdf", "x", x.cols(), dim(), dim());
  return copula_->cdf(to_uniforms(x));
}

Column JointDistribution::conditional_cdf(const PointsRef& x) const {
  return copula_->h(to_uniforms(x));
}

Column JointDistribution::conditional_quantile(const PointsRef& x) const {
  require_columns("conditional_quantile", "x", x.cols(), 1, dim());
  const Index last = x.cols() - 1;
  Points u(x.rows(), x.cols());
  if (last > 0) u.leftCols(last) = to_uniforms(x.leftCols(last));
  u.col(last) = x.col(last);
  return margins_[static_cast<std::size_t>(last)]->quantile(copula_->h_inv(u));
}

Points JointDistribution::inverse_rosenblatt(const PointsRef& w, const PointsRef& given) const {
  return values(copula_->inverse_rosenblatt(w, given.cols() > 0 ? to_uniforms(given) : Points(given)), given);
}

Points JointDistribution::sample(Index n, Rng& rng, const PointsRef& given) const {
  return values(copula_->sample(n, rng, given.cols() > 0 ? to_uniforms(given) : Points(given)), given);
}

Points JointDistribution::values(const Points& u, const PointsRef& given) const {
  const Index fixed = given.cols();
  Points x(u.rows(), u.cols());
  if (given.rows() == 1) {
    x.leftCols(fixed) = given.replicate(u.rows(), 1);
  } else {
    x.leftCols(fixed) = given;
  }
  for (Index i = fixed; i < x.cols(); ++i) x.col(i) = margins_[static_cast<std::size_t>(i)]->quantile(u.col(i));
  return x;
}

JointDensity::JointDensity(std::vector<std::shared_ptr<const DensityMarginal>> margins, CopulaPtr copula)
    : JointDistribution({margins.begin(), margins.end()}, std::move(copula)), densities_(std::move(margins)) {}

Column JointDensity::log_pdf(const PointsRef& x) const {
  require_columns("log_pdf", "x", x.cols(), dim(), dim());
  Column margins = Column::Zero(x.rows());
  for (Index i = 0; i < x.cols(); ++i) margins += densities_[static_cast<std::size_t>(i)]->log_pdf(x.col(i));
  // Where a margin has no density the joint one has none, whatever the limit of the copula's there.
  constexpr double kNone = -std::numeric_limits<double>::infinity();
  return (margins == kNone).select(kNone, margins + copula().log_pdf(to_uniforms(x)));
}

}  // namespace sklar
