#include "brdf/analytic/analytic_fit.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "brdf/analytic/fit_cells.hpp"
#include "brdf/analytic/search_space.hpp"

namespace sklar::brdf {
namespace {

constexpr std::array kSoftness = {0.03, 0.01, 0.003};  // of the stages
constexpr double kDifference = 1e-7;                   // step of a slope
constexpr int kColourEvaluations = 8;                  // of the first searches
constexpr std::size_t kRefined = 6;                    // how many go on with all values
constexpr int kRefinedEvaluations = 30;
constexpr std::size_t kSettled = 3, kFinal = 2;  // and until they settle, and to the end

/// A value that is not finite is worse than any that is.
Evaluation evaluation(double value) {
  if (std::isfinite(value)) return {.value = value};
  return {.value = std::numeric_limits<double>::max(), .nonfinite = 1};
}

/// The objective as a function of the coordinates of some groups, the others kept.
class Problem {
 public:
  Problem(const AnalyticInfo& info, const SearchSpace& space, const BalancedError& error, double softness,
          bool colours_only)
      : info_(info), space_(space), error_(error), softness_(softness) {
    for (const SearchSpace::Group& group : space.groups()) {
      if (!colours_only || group.count > 1) groups_.push_back(group);
    }
  }

  /// Searches from z, which becomes the best point seen. Returns its value.
  double search(std::vector<double>& z, int evaluations, double tolerance) {
    if (groups_.empty()) return evaluate(z).value;
    at_ = z;
    Box box;
    for (const std::size_t n : free_coordinates()) {
      box.lower.push_back(space_.box().lower[n]);
      box.upper.push_back(space_.box().upper[n]);
    }
    const auto objective = [&](const std::vector<double>& part) { return evaluate(whole(part)); };
    const auto gradient = [&](const std::vector<double>& part) { return slopes(whole(part)); };
    const MinimiseOptions options{.step = 0.3, .tolerance = tolerance, .max_evaluations = evaluations};
    const Minimum minimum = minimise(objective, part_of(z), box, options, gradient);
    z = whole(minimum.z);
    converged_ = minimum.stop == MinimiseStop::tolerance;
    return minimum.best.value;
  }

  Evaluation evaluate(const std::vector<double>& z) {
    last_z_ = z;
    last_ = channels(z);
    return evaluation(last_.mean());
  }

  [[nodiscard]] int evaluations() const { return evaluations_; }
  [[nodiscard]] bool converged() const { return converged_; }

 private:
  /// The objective of each channel; NaN where the search has lost its way, which ends it.
  Rgb channels(const std::vector<double>& z) {
    if (!std::ranges::all_of(z, [](double x) { return std::isfinite(x); })) return Rgb::Constant(std::nan(""));
    ++evaluations_;
    return error_(*info_.make(space_.values(z)), softness_);
  }

  /// By differences; a value per channel moves that channel's objective alone.
  std::vector<double> slopes(const std::vector<double>& z) {
    if (z != last_z_) evaluate(z);
    const Rgb here = last_;
    std::vector<double> result;
    for (const SearchSpace::Group& group : groups_) {
      std::vector<double> moved = z;
      std::array<double, 3> step{};
      for (std::size_t n = 0; n < group.count; ++n) {
        const std::size_t at = group.first + n;
        step[n] = z[at] + kDifference > space_.box().upper[at] ? -kDifference : kDifference;
        moved[at] += step[n];
      }
      const Rgb change = (channels(moved) - here) / 3;
      for (std::size_t n = 0; n < group.count; ++n) {
        result.push_back((group.count > 1 ? change[static_cast<Eigen::Index>(n)] : change.sum()) / step[n]);
      }
    }
    return result;
  }

  [[nodiscard]] std::vector<std::size_t> free_coordinates() const {
    std::vector<std::size_t> result;
    for (const SearchSpace::Group& group : groups_) {
      for (std::size_t n = 0; n < group.count; ++n) result.push_back(group.first + n);
    }
    return result;
  }

  [[nodiscard]] std::vector<double> part_of(const std::vector<double>& z) const {
    std::vector<double> result;
    for (const std::size_t n : free_coordinates()) result.push_back(z[n]);
    return result;
  }

  [[nodiscard]] std::vector<double> whole(const std::vector<double>& part) const {
    std::vector<double> result = at_;
    auto next = part.begin();
    for (const std::size_t n : free_coordinates()) result[n] = *next++;
    return result;
  }

  const AnalyticInfo& info_;
  const SearchSpace& space_;
  const BalancedError& error_;
  double softness_;
  std::vector<SearchSpace::Group> groups_;
  std::vector<double> at_, last_z_;
  Rgb last_ = Rgb::Zero();
  int evaluations_ = 0;
  bool converged_ = true;
};

struct Candidate {
  std::vector<double> z;
  double objective = 0;
  int evaluations = 0;
  bool converged = false;
};

/// One stage of one search.
void improve(const AnalyticInfo& info, const SearchSpace& space, const BalancedError& error, double softness,
             bool colours_only, int evaluations, Candidate& candidate) {
  constexpr double kCoarse = 1e-3, kFine = 1e-6;
  Problem problem(info, space, error, softness, colours_only);
  const bool last = softness == kSoftness.back();
  candidate.objective = problem.search(candidate.z, evaluations, last ? kFine : kCoarse);
  candidate.evaluations += problem.evaluations();
  candidate.converged = problem.converged();
}

/// The best `count`, in order; of equals the earlier one first.
void keep_best(std::vector<Candidate>& candidates, std::size_t count) {
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.objective < b.objective; });
  if (candidates.size() > count) candidates.resize(count);
}

/// Points in [0,1)^dimensions: multiples of the powers of 1 / g, g^(dimensions + 1) = g + 1, modulo 1 (Roberts 2018,
/// "The Unreasonable Effectiveness of Quasirandom Sequences").
std::vector<std::vector<double>> spread_points(std::size_t dimensions, std::size_t count) {
  double g = 1.5;
  for (int n = 0; n < 60; ++n) g = std::pow(1 + g, 1 / (1.0 + static_cast<double>(dimensions)));
  std::vector<std::vector<double>> points(count, std::vector<double>(dimensions));
  for (std::size_t n = 0; n < points.size(); ++n) {
    double power = 1;
    for (double& x : points[n]) x = std::fmod(0.5 + static_cast<double>(n + 1) * (power /= g), 1.0);
  }
  return points;
}

std::vector<Candidate> starts_of(const AnalyticInfo& info, const SearchSpace& space, std::size_t shapes) {
  std::vector<Candidate> starts = {{space.coordinates(info.initial())}};
  for (const AnalyticValues& example : info.examples) starts.push_back({space.coordinates(example)});
  const auto scalars = static_cast<std::size_t>(
      std::ranges::count_if(space.groups(), [](const SearchSpace::Group& group) { return group.count == 1; }));
  for (const std::vector<double>& point : spread_points(scalars, shapes * scalars))
    starts.push_back({space.start(point)});
  return starts;
}

/// The whole search: the values per channel from every start, then all values from ever fewer of the points found.
class MultiStart {
 public:
  MultiStart(const AnalyticInfo& info, const BalancedError& error, const AnalyticFitOptions& options)
      : info_(info),
        error_(error),
        options_(options),
        space_(info),
        starts_(starts_of(info, space_, static_cast<std::size_t>(options.shapes))) {}

  [[nodiscard]] int searches() const {
    std::size_t sum = starts_.size();
    for (const std::size_t kept : {kRefined, kSettled, kFinal}) sum += std::min(starts_.size(), kept);
    return static_cast<int>(sum);
  }

  void run(AnalyticFit& fit, ProgressCounter& counter) {
    const double sharpest = kSoftness.back();
    std::vector<Candidate> best = starts_;
    each(best, counter, [&](Candidate& c, std::size_t n) {
      starts_[n].objective = value(starts_[n].z, sharpest);
      improve(info_, space_, error_, kSoftness.front(), true, kColourEvaluations, c);
    });
    count(best, fit);
    keep_best(best, kRefined);
    each(best, counter, [&](Candidate& c, std::size_t) {
      improve(info_, space_, error_, kSoftness.front(), false, kRefinedEvaluations, c);
    });
    count(best, fit);
    keep_best(best, kSettled);
    const int evaluations = options_.evaluations * static_cast<int>(space_.size());
    each(best, counter,
         [&](Candidate& c, std::size_t) { improve(info_, space_, error_, kSoftness.front(), false, evaluations, c); });
    count(best, fit);
    keep_best(best, kFinal);
    each(best, counter, [&](Candidate& c, std::size_t) {
      for (std::size_t n = 1; n < kSoftness.size(); ++n) {
        improve(info_, space_, error_, kSoftness[n], false, evaluations, c);
      }
    });
    count(best, fit);
    fit.evaluations += static_cast<int>(starts_.size());
    for (const Candidate& start : starts_) fit.starts.push_back({space_.values(start.z), start.objective});
    best.insert(best.end(), starts_.begin(), starts_.end());
    keep_best(best, 1);
    fit.values = space_.values(best.front().z);
    fit.objective = best.front().objective;
    fit.status = best.front().converged ? AnalyticFitStatus::converged : AnalyticFitStatus::max_evaluations;
  }

 private:
  template <typename Work>
  static void each(std::vector<Candidate>& candidates, ProgressCounter& counter, const Work& work) {
    tbb::parallel_for(std::size_t{0}, candidates.size(), [&](std::size_t n) {
      work(candidates[n], n);
      counter.step();
    });
  }

  static void count(std::vector<Candidate>& candidates, AnalyticFit& fit) {
    for (Candidate& candidate : candidates) fit.evaluations += std::exchange(candidate.evaluations, 0);
  }

  [[nodiscard]] double value(const std::vector<double>& z, double softness) const {
    return evaluation(error_(*info_.make(space_.values(z)), softness).mean()).value;
  }

  const AnalyticInfo& info_;
  const BalancedError& error_;
  const AnalyticFitOptions& options_;
  SearchSpace space_;
  std::vector<Candidate> starts_;
};

}  // namespace

std::string_view to_text(AnalyticFitStatus status) {
  constexpr std::array<std::string_view, 4> kNames = {"converged", "max_evaluations", "black", "underdetermined"};
  return kNames[static_cast<std::size_t>(status)];
}

AnalyticFit fit_analytic(const AnalyticInfo& info, const MeasuredTable& table, const AnalyticFitOptions& options,
                         const Progress& progress) {
  if (options.shapes < 0 || options.evaluations < 1) {
    throw std::invalid_argument("fit_analytic: shapes must be at least 0 and evaluations at least 1, got " +
                                std::to_string(options.shapes) + " and " + std::to_string(options.evaluations));
  }
  const BalancedError error(fit_cells(table));
  MultiStart search(info, error, options);
  ProgressCounter counter(progress, search.searches());
  AnalyticFit fit;
  fit.cells = error.cells().in_table;
  search.run(fit, counter);
  fit.brdf = info.make(fit.values);
  if (error.cells().mean_square == 0) {
    fit.status = AnalyticFitStatus::black;
  } else if (3 * error.cells().size() < static_cast<Eigen::Index>(SearchSpace(info).size())) {
    fit.status = AnalyticFitStatus::underdetermined;
  }
  return fit;
}

}  // namespace sklar::brdf
