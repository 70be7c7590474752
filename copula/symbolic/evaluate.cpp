#include "copula/symbolic/evaluate.hpp"

#include <algorithm>
#include <optional>

#include "copula/big_float.hpp"
#include "copula/error.hpp"
#include "copula/symbolic/tape_evaluator.hpp"

namespace sklar::symbolic {

namespace {

template <class Real>
bool accepted(const Bounded<Real>& x, const EvaluationOptions& options) {
  using std::abs, std::isfinite;
  if (!isfinite(x.value) || !isfinite(x.error)) return false;
  const Real size = abs(x.value);
  return x.error <= options.tolerance * (size > options.floor ? size : Real(options.floor));
}

using Row = std::vector<double>;

std::string describe(const Tape& tape, const Row& inputs) {
  std::string text;
  for (std::size_t j = 0; j < inputs.size(); ++j) {
    text += (j ? ", " : "") + tape.inputs()[j] + " = " + to_text(inputs[j]);
  }
  return text.empty() ? "no inputs" : text;
}

/// Runs single rows in one type.
template <class Real>
class RowRunner {
 public:
  explicit RowRunner(const Tape& tape) : run_(tape), out_(tape.outputs().size()) {}

  /// The outputs, if all are accepted.
  std::optional<Row> operator()(const Row& inputs, const EvaluationOptions& options) {
    std::vector<Bounded<Real>> in;
    for (const double x : inputs) in.emplace_back(Real(x), Real(0));
    run_(in, out_);
    Row values;
    for (const Bounded<Real>& x : out_) {
      if (!accepted(x, options)) return std::nullopt;
      values.push_back(static_cast<double>(x.value));
    }
    return values;
  }

  [[nodiscard]] bool finite() const {
    using std::isfinite;
    return std::all_of(out_.begin(), out_.end(), [](const Bounded<Real>& x) { return isfinite(x.value); });
  }

 private:
  TapeEvaluator<Bounded<Real>, 1> run_;
  std::vector<Bounded<Real>> out_;
};

/// Repeats rows in wider types.
class Promoter {
 public:
  Promoter(const Tape& tape, const EvaluationOptions& options) : tape_(tape), options_(options), extended_(tape) {}

  struct Result {
    Row values;
    int digits;
  };

  Result operator()(const Row& inputs) {
    if (auto values = extended_(inputs, options_)) return {*values, std::numeric_limits<long double>::digits10};
    bool finite = extended_.finite();
    int digits = 0;
    for (int next = kFirstDigits; next <= options_.max_digits; next *= 2) {
      const WorkingPrecision precision(digits = next);
      RowRunner<BigFloat> run(tape_);
      if (auto values = run(inputs, options_)) return {*values, digits};
      finite = run.finite();
    }
    throw std::domain_error((finite ? "value not resolved with " + std::to_string(digits) + " digits"
                                    : std::string("value not defined or not finite")) +
                            " at " + describe(tape_, inputs));
  }

 private:
  static constexpr int kFirstDigits = 50;

  const Tape& tape_;
  const EvaluationOptions& options_;
  RowRunner<long double> extended_;
};

}  // namespace

Evaluation evaluate(const Tape& tape, const PointsRef& inputs, const EvaluationOptions& options) {
  const auto n = static_cast<Index>(tape.inputs().size());
  const auto m = static_cast<Index>(tape.outputs().size());
  require_columns("evaluate", "inputs", inputs.cols(), n, n);
  Evaluation result{Points(inputs.rows(), m), 0, std::numeric_limits<double>::digits10};
  std::vector<Bounded<double>> in(static_cast<std::size_t>(inputs.rows() * n));
  std::vector<Bounded<double>> out(static_cast<std::size_t>(inputs.rows() * m));
  for (Index row = 0; row < inputs.rows(); ++row) {
    for (Index j = 0; j < n; ++j) in[static_cast<std::size_t>(row * n + j)] = Bounded<double>(inputs(row, j));
  }
  TapeEvaluator<Bounded<double>> run(tape);
  run(in, out);
  Promoter promote(tape, options);
  for (Index row = 0; row < inputs.rows(); ++row) {
    if (inputs.row(row).isNaN().any()) {
      result.values.row(row) = std::numeric_limits<double>::quiet_NaN();
      continue;
    }
    bool good = true;
    for (Index j = 0; j < m; ++j) {
      const Bounded<double>& x = out[static_cast<std::size_t>(row * m + j)];
      result.values(row, j) = x.value;
      good = good && accepted(x, options);
    }
    if (good) continue;
    const Column row_inputs = inputs.row(row);
    const auto [values, digits] = promote(Row(row_inputs.begin(), row_inputs.end()));
    for (Index j = 0; j < m; ++j) result.values(row, j) = values[static_cast<std::size_t>(j)];
    ++result.promoted;
    result.most_digits = std::max(result.most_digits, digits);
  }
  return result;
}

}  // namespace sklar::symbolic
