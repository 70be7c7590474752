#include "copula/inference/held_out.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "copula/inference/checks.hpp"
#include "copula/inference/joint_fit.hpp"
#include "copula/random.hpp"

namespace sklar {
namespace {

/// The rows in random order, so that every folds-th from any of the first on makes a part.
std::vector<Index> random_order(Index rows, std::uint64_t seed) {
  std::vector<Index> order(static_cast<std::size_t>(rows));
  std::iota(order.begin(), order.end(), Index{0});
  Rng rng(seed);
  for (std::size_t i = order.size(); i > 1; --i) {
    std::swap(order[i - 1], order[static_cast<std::size_t>(uniform(rng) * static_cast<double>(i))]);
  }
  return order;
}

struct Rows {
  Points x;
  Column weights;
};

Rows pick(const PointsRef& x, const ColumnRef& weights, const std::vector<Index>& rows) {
  return {x(rows, Eigen::all), weights.size() > 0 ? Column(weights(rows)) : Column()};
}

/// Held-out rows behind margins fitted to others.
Points uniforms_at(std::span<const MarginFit> margins, const Points& x) {
  Points u = x;
  for (std::size_t i = 0; i < margins.size(); ++i) {
    const auto column = static_cast<Index>(i);
    if (const auto* ranks = std::get_if<EmpiricalMarginal>(&margins[i].margin)) {
      u.col(column) = x.col(column).unaryExpr([&](double value) { return ranks->pseudo_observation(value); });
    } else {
      u.col(column) = share(margins[i].margin)->cdf(x.col(column));
    }
  }
  return u;
}

/// Row by row; with an empirical margin of the copula alone.
Column log_likelihoods(const JointFit& fit, const Copula& copula, const Points& x) {
  Column terms = copula.log_pdf(uniforms_at(fit.margins, x));
  const bool densities = std::none_of(fit.margins.begin(), fit.margins.end(), [](const MarginFit& margin) {
    return margin.spec.kind == MarginKind::empirical;
  });
  for (std::size_t i = 0; densities && i < fit.margins.size(); ++i) {
    terms += density_of(fit.margins[i].margin)->log_pdf(x.col(static_cast<Index>(i)));
  }
  return terms;
}

/// What one family has said about the rows held out so far.
struct Scores {
  std::vector<double> terms, weights;
  std::string message;

  void add(const Column& found, const Column& of_weights) {
    terms.insert(terms.end(), found.begin(), found.end());
    for (Index i = 0; i < found.size(); ++i) weights.push_back(of_weights.size() > 0 ? of_weights[i] : 1.0);
  }

  [[nodiscard]] HeldOut summary() const {
    if (!message.empty()) return {.message = message};
    const Eigen::Map<const Column> all(terms.data(), static_cast<Index>(terms.size()));
    const Eigen::Map<const Column> w(weights.data(), all.size());
    const Index broken = (w > 0 && !all.isFinite()).count();
    if (broken > 0) {
      return {.mean = -std::numeric_limits<double>::infinity(),
              .message = std::to_string(broken) + " held-out rows have no finite density"};
    }
    const Column l = (w > 0).select(all, 0.0);
    const double n = w.sum(), mean = (w * l).sum() / n;
    return {.mean = mean, .standard_error = std::sqrt((w * (l - mean).square()).sum() / (n - 1) / n)};
  }
};

class HeldOutStudy {
 public:
  HeldOutStudy(std::span<const FamilyInfo* const> families, FitMethod method, std::span<const MarginSpec> specs,
               bool together)
      : families_(families), method_(method), specs_(specs), together_(together), scores_(families.size()) {}

  void add_part(int part, const Rows& training, const Rows& held_out) {
    const std::vector<MarginFit> margins =
        specs_.empty() ? std::vector<MarginFit>() : fit_margins(specs_, training.x, training.weights);
    const Points u = specs_.empty() ? training.x : uniforms_of(margins, training.x, training.weights);
    for (std::size_t i = 0; i < families_.size(); ++i) {
      if (!scores_[i].message.empty()) continue;
      try {
        const JointFit fit = fit_to(*families_[i], margins, u, training);
        const CopulaPtr copula = families_[i]->make(static_cast<int>(u.cols()), fit.copula.theta);
        scores_[i].add(log_likelihoods(fit, *copula, held_out.x), held_out.weights);
      } catch (const std::exception& error) {
        scores_[i].message = "part " + std::to_string(part + 1) + ": " + error.what();
      }
    }
  }

  [[nodiscard]] std::vector<HeldOut> summaries() const {
    std::vector<HeldOut> summaries;
    for (const Scores& scores : scores_) summaries.push_back(scores.summary());
    return summaries;
  }

 private:
  [[nodiscard]] JointFit fit_to(const FamilyInfo& family, const std::vector<MarginFit>& margins, const Points& u,
                                const Rows& training) const {
    const FitOptions options{.standard_errors = false};
    const FitResult copula = fit(family, method_, u, training.weights, options);
    JointFit start = two_step_fit(margins, copula, static_cast<double>(u.rows()));
    if (together_) start = fit_together(family, start, training.x, training.weights, options);
    if (start.copula.status == FitStatus::failed) throw std::runtime_error(start.copula.message);
    return start;
  }

  std::span<const FamilyInfo* const> families_;
  FitMethod method_;
  std::span<const MarginSpec> specs_;
  bool together_;
  std::vector<Scores> scores_;
};

}  // namespace

std::vector<HeldOut> held_out_likelihood(std::span<const FamilyInfo* const> families, FitMethod method,
                                         std::span<const MarginSpec> specs, const PointsRef& x,
                                         const ColumnRef& weights, const HeldOutOptions& options) {
  require_weights("held_out_likelihood", weights, x.rows());
  if (options.folds < 2 || options.folds > x.rows()) {
    throw std::invalid_argument("held_out_likelihood: folds must be in 2 to the number of rows, " +
                                std::to_string(x.rows()) + ", got " + std::to_string(options.folds));
  }
  const std::vector<Index> order = random_order(x.rows(), options.seed);
  HeldOutStudy study(families, method, specs, options.together);
  for (int part = 0; part < (options.every_fold ? options.folds : 1); ++part) {
    std::vector<Index> inside, outside;
    for (std::size_t i = 0; i < order.size(); ++i) {
      const bool held_out = i % static_cast<std::size_t>(options.folds) == static_cast<std::size_t>(part);
      (held_out ? inside : outside).push_back(order[i]);
    }
    std::sort(inside.begin(), inside.end());
    std::sort(outside.begin(), outside.end());
    study.add_part(part, pick(x, weights, outside), pick(x, weights, inside));
  }
  return study.summaries();
}

}  // namespace sklar
