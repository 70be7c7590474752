#include "copula/symbolic/log_density_gradient.hpp"

#include "copula/error.hpp"
#include "copula/first_answer.hpp"
#include "copula/row.hpp"
#include "copula/symbolic/log_form.hpp"
#include "copula/symbolic/parser.hpp"
#include "copula/symbolic/symbolic_generator.hpp"

namespace sklar::symbolic {

namespace {

constexpr double kTolerance = 1e-10;

std::vector<std::string> parameter_names(const FamilyInfo& family) {
  std::vector<std::string> names;
  for (const ParameterInfo& parameter : family.parameters) names.push_back(parameter.name);
  return names;
}

/// log|psi^(order)| differentiated by t, then by each parameter.
std::vector<Expression> log_slopes(const FamilyInfo& family, int order) {
  const Expression t = symbol("t");
  const Expression log_abs = log_form(derivative(parse(family.psi), t, order)).log_abs;
  std::vector<Expression> slopes{derivative(log_abs, t)};
  for (const ParameterInfo& parameter : family.parameters) {
    slopes.push_back(derivative(log_abs, symbol(parameter.name)));
  }
  return slopes;
}

std::vector<Expression> margin_slopes(const FamilyInfo& family) {
  std::vector<Expression> slopes = log_slopes(family, 1);
  const std::vector<Expression> of_psi = log_slopes(family, 0);
  slopes.insert(slopes.end(), of_psi.begin(), of_psi.end());
  return slopes;
}

int require_dimension(int dim) {
  if (dim >= 2 && dim <= kMaxDimension) return dim;
  throw std::invalid_argument("log density gradient: the dimension must be from 2 to " + std::to_string(kMaxDimension) +
                              ", got " + std::to_string(dim));
}

Reflection reflection_of(const FamilyInfo& family, int dim) {
  family.require_dimension(dim);
  return Reflection(family.rotation.in(dim));
}

/// What the tapes need of the parameters alone.
template <class T>
struct Prepared {
  Prepared(const SplitTape* sum, const SplitTape* margins, const Theta& theta)
      : at_sum(sum->prepare<T>(theta)), at_margins(margins->prepare<T>(theta)) {}

  std::vector<T> at_sum, at_margins;
};

/// The gradient of single rows for given parameters.
class RowGradient {
 public:
  RowGradient(std::shared_ptr<const GeneratorFormula> psi, const SplitTape& at_sum, const SplitTape& at_margins,
              const Theta& theta)
      : psi_(std::move(psi), 1, theta),
        at_sum_(at_sum),
        at_margins_(at_margins),
        parameters_(theta.size()),
        prepared_(&at_sum, &at_margins, theta) {}

  /// NaN where no number type resolves all entries.
  [[nodiscard]] std::vector<double> operator()(const Row& row) const {
    const auto found = first_answer([&]<class T>() { return resolved(evaluate<T>(RowOf<T>(row).all())); });
    return found.value_or(std::vector<double>(parameters_, std::numeric_limits<double>::quiet_NaN()));
  }

 private:
  template <class T>
  static std::optional<std::vector<double>> resolved(const std::vector<T>& gradient) {
    std::vector<double> values;
    for (const T& entry : gradient) {
      if (!is_within(kTolerance, entry)) return std::nullopt;
      values.push_back(static_cast<double>(entry.value));
    }
    return values;
  }

  template <class T>
  std::vector<T> evaluate(std::span<const T> u) const {
    const Prepared<T>& prepared = prepared_.get<T>();
    T sum(0.0);
    std::vector<T> sum_slope(parameters_, T(0.0)), gradient(parameters_, T(0.0));
    for (const T& value : u) {
      const T t = psi_.psi_inv(value);
      sum += t;
      const auto slopes = at_margins_.run<T>(prepared.at_margins, t);
      const std::size_t of_psi = parameters_ + 1;
      for (std::size_t j = 0; j < parameters_; ++j) {
        const T t_slope = -slopes[of_psi + 1 + j] / slopes[of_psi];
        sum_slope[j] += t_slope;
        gradient[j] -= slopes[1 + j] + slopes[0] * t_slope;
      }
    }
    const auto slopes = at_sum_.run<T>(prepared.at_sum, sum);
    for (std::size_t j = 0; j < parameters_; ++j) gradient[j] += slopes[1 + j] + slopes[0] * sum_slope[j];
    return gradient;
  }

  SymbolicGenerator psi_;
  const SplitTape& at_sum_;
  const SplitTape& at_margins_;
  std::size_t parameters_;
  PerPrecision<Prepared> prepared_;
};

}  // namespace

LogDensityGradient::LogDensityGradient(const FamilyInfo& family, int dim)
    : psi_(std::make_shared<const GeneratorFormula>(parse(family.psi), std::nullopt, parameter_names(family))),
      at_sum_(log_slopes(family, require_dimension(dim)), "t", parameter_names(family)),
      at_margins_(margin_slopes(family), "t", parameter_names(family)),
      dim_(dim),
      reflection_(reflection_of(family, dim)) {}

Points LogDensityGradient::operator()(const Theta& theta, const PointsRef& u) const {
  require_columns("log density gradient", "u", u.cols(), dim_, dim_);
  if (theta.size() != psi_->parameters().size()) {
    throw std::invalid_argument("log density gradient: takes " + std::to_string(psi_->parameters().size()) +
                                " parameters, got " + std::to_string(theta.size()));
  }
  const RowGradient gradient(psi_, at_sum_, at_margins_, theta);
  Points result(u.rows(), static_cast<Index>(theta.size()));
  std::vector<double> row(static_cast<std::size_t>(dim_));
  for (Index i = 0; i < u.rows(); ++i) {
    for (Index k = 0; k < dim_; ++k) row[static_cast<std::size_t>(k)] = u(i, k);
    const std::vector<double> entries = gradient({row, &reflection_});
    for (Index j = 0; j < result.cols(); ++j) result(i, j) = entries[static_cast<std::size_t>(j)];
  }
  return result;
}

}  // namespace sklar::symbolic
