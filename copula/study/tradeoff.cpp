#include "copula/study/tradeoff.hpp"

#include <cmath>
#include <functional>
#include <stdexcept>

#include "copula/study/timing.hpp"
#include "copula/symbolic/formula_family.hpp"

namespace sklar {
namespace {

constexpr double kTau = 0.5;
constexpr double kShareOfHighest = 0.75;

struct Evaluation {
  const char* name;
  Quantity quantity;
  Column (Copula::*evaluate)(const PointsRef&, Accuracy) const;
  ErrorMeasure measure;
};

constexpr Evaluation kEvaluations[] = {
    {"log_pdf", Quantity::log_pdf, &Copula::log_pdf, ErrorMeasure::logarithm},
    {"h", Quantity::h, &Copula::h, ErrorMeasure::relative},
    {"h_inv", Quantity::h_inv, &Copula::h_inv, ErrorMeasure::relative},
};

/// The copula of one family in the ways it can be had.
struct Subject {
  const FamilyInfo& family;
  Theta theta;
  CopulaPtr copula;
  CopulaPtr formula;  ///< null for a family without psi, and in dimensions that formulas do not have
  Points u;
};

Subject make_subject(const FamilyInfo& family, const TradeoffOptions& options) {
  Theta theta = medium_theta(family, options.dim);
  CopulaPtr copula = family.make(options.dim, theta);
  CopulaPtr formula;
  if (!family.psi.empty()) {
    const FamilyInfo by_formula = symbolic::formula_of(family);
    if (by_formula.dimensions.contains(options.dim)) formula = by_formula.make(options.dim, theta);
  }
  Rng rng(options.seed);
  Points u = copula->sample(options.rows, rng);
  return {family, std::move(theta), std::move(copula), std::move(formula), std::move(u)};
}

std::vector<BigFloat> to_big(const Column& values) {
  return {values.begin(), values.end()};
}

/// The rows of one quantity.
class Measurement {
 public:
  Measurement(const Subject& subject, const Evaluation& evaluation, int digits)
      : subject_(subject),
        evaluation_(evaluation),
        reference_(subject.copula->exact(evaluation.quantity, subject.u, 2 * digits)) {}

  void add_doubles(const char* level, const Copula& copula, Accuracy accuracy = Accuracy::standard) {
    Column values;
    const double seconds = seconds_per_call([&] { values = (copula.*evaluation_.evaluate)(subject_.u, accuracy); });
    add(level, seconds, to_big(values));
  }

  void add_exact(int digits) {
    std::vector<BigFloat> values;
    const double seconds =
        seconds_per_call([&] { values = subject_.copula->exact(evaluation_.quantity, subject_.u, digits); });
    add("exact", seconds, values);
  }

  [[nodiscard]] const std::vector<TradeoffRow>& rows() const { return rows_; }

 private:
  void add(const char* level, double seconds, const std::vector<BigFloat>& values) {
    rows_.push_back({.family = subject_.family.name,
                     .theta = subject_.theta,
                     .quantity = evaluation_.name,
                     .level = level,
                     .ns = seconds / static_cast<double>(values.size()) * 1e9,
                     .errors = value_errors(evaluation_.measure, values, reference_)});
  }

  const Subject& subject_;
  const Evaluation& evaluation_;
  std::vector<BigFloat> reference_;
  std::vector<TradeoffRow> rows_;
};

}  // namespace

Theta medium_theta(const FamilyInfo& family, int dim) {
  family.require_dimension(dim);
  if (family.theta_from_tau) {
    const Interval range = family.tau_range(dim);
    return family.from_tau(dim, range.contains(kTau) ? kTau : kShareOfHighest * range.highest);
  }
  if (family.examples.empty()) throw std::invalid_argument(family.name + ": has no examples of its parameters");
  const Theta* best = nullptr;
  double best_tau = -1;
  for (const Theta& theta : family.examples) {
    if (!family.admits(dim, theta)) continue;
    const double tau = family.tau(theta);
    const bool nearer = tau < kTau && tau > best_tau;
    if (best == nullptr || nearer) best = &theta;
    if (nearer) best_tau = tau;
  }
  return best == nullptr ? family.examples.front() : *best;
}

std::vector<TradeoffRow> measure_tradeoff(const FamilyInfo& family, const TradeoffOptions& options) {
  const Subject subject = make_subject(family, options);
  std::vector<TradeoffRow> rows;
  for (const Evaluation& evaluation : kEvaluations) {
    Measurement measurement(subject, evaluation, options.digits);
    measurement.add_doubles("fast", *subject.copula, Accuracy::fast);
    measurement.add_doubles("standard", *subject.copula);
    if (subject.formula) measurement.add_doubles("symbolic", *subject.formula);
    measurement.add_exact(options.digits);
    rows.insert(rows.end(), measurement.rows().begin(), measurement.rows().end());
  }
  return rows;
}

}  // namespace sklar
