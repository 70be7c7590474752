#include "copula/symbolic/formula_family.hpp"

#include <algorithm>
#include <cmath>

#include "copula/archimedean.hpp"
#include "copula/error.hpp"
#include "copula/rotated.hpp"
#include "copula/symbolic/evaluate.hpp"
#include "copula/symbolic/formula_dependence.hpp"
#include "copula/symbolic/generator_check.hpp"
#include "copula/symbolic/near_zero.hpp"
#include "copula/symbolic/node.hpp"
#include "copula/symbolic/parser.hpp"

namespace sklar::symbolic {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

[[noreturn]] void refuse(const std::string& field, const std::string& what) {
  throw std::invalid_argument("field '" + field + "': " + what);
}

Expression formula(const std::string& field, const std::string& text, const std::vector<std::string>& symbols) {
  try {
    return parse(text, symbols);
  } catch (const ParseError& error) {
    refuse(field, error.what());
  }
}

/// One end of the domain of a parameter.
class Bound {
 public:
  Bound(const std::string& field, const std::string& text) {
    if (text == "inf" || text == "-inf") {
      infinite_ = text == "inf" ? kInfinity : -kInfinity;
    } else {
      value_ = formula(field, text, {"d"});
    }
  }

  /// In dimension dim; where a double cannot hold the bound, the next one towards inwards.
  [[nodiscard]] double at(int dim, double inwards) const {
    if (infinite_ != 0) return infinite_;
    const Expression value = substitute(value_, symbol("d"), dim);
    const double nearest = evaluate(Tape({value}, {}), Points(1, 0)).values(0);
    if (!value.is_number()) return nearest;
    const Rational exact = symbolic::value_of(value);
    const Rational found(nearest);  // NOLINT(clang-analyzer-core.*): false alarm inside Boost.Rational
    const bool outside = inwards > nearest ? found < exact : found > exact;
    return outside ? std::nextafter(nearest, inwards) : nearest;
  }

 private:
  double infinite_ = 0;
  Expression value_;
};

class FormulaFamily {
 public:
  explicit FormulaFamily(const FamilyDefinition& definition) : definition_(definition) {
    require_name(definition.name);
    for (const ParameterDefinition& parameter : definition.parameters) add_parameter(parameter);
    const auto with = [this](const char* variable) {
      std::vector<std::string> symbols{variable};
      symbols.insert(symbols.end(), names_.begin(), names_.end());
      return symbols;
    };
    const Expression psi = formula("psi", definition.psi, with("t"));
    std::optional<Expression> inverse;
    if (!definition.psi_inverse.empty()) inverse = formula("psi_inverse", definition.psi_inverse, with("u"));
    if (!psi.depends_on(symbol("t"))) refuse("psi", "must depend on t");
    formula_ = std::make_shared<const GeneratorFormula>(psi, inverse, names_);
  }

  [[nodiscard]] Interval domain(std::size_t parameter, int dim) const {
    const ParameterDefinition& p = definition_.parameters[parameter];
    const Interval domain{bounds_[parameter].first.at(dim, kInfinity), bounds_[parameter].second.at(dim, -kInfinity),
                          p.lowest_included, p.highest_included};
    if (domain.lowest <= domain.highest) return domain;
    throw std::domain_error(definition_.name + ": " + p.name + " has no value in dimension " + std::to_string(dim) +
                            ": its bounds are " + domain.to_text());
  }

  [[nodiscard]] CopulaPtr make(int dim, const Theta& theta) const {
    const SymbolicGenerator generator(formula_, dim, theta, subject(theta));
    require_generator(generator, dim, subject(theta));
    return std::make_shared<Archimedean<SymbolicGenerator>>(dim, generator);
  }

  [[nodiscard]] double tau(const Theta& theta) const { return kendall_tau(generator(theta)); }
  [[nodiscard]] TailDependence tails(const Theta& theta) const { return tail_dependence(generator(theta)); }

 private:
  static void require_name(const std::string& name) {
    const auto allowed = [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
    };
    if (!name.empty() && name != "all" && std::all_of(name.begin(), name.end(), allowed)) return;
    refuse("name", "must be of lower-case letters, digits, - and _, and not 'all', found '" + name + "'");
  }

  void add_parameter(const ParameterDefinition& parameter) {
    const std::string field = "parameters[" + std::to_string(names_.size()) + "]";
    const Expression e = formula(field + ".name", parameter.name, {parameter.name});
    const bool reserved = parameter.name == "t" || parameter.name == "u" || parameter.name == "d";
    if (e.kind() != Kind::symbol || reserved || std::count(names_.begin(), names_.end(), parameter.name) > 0) {
      refuse(field + ".name", "must be a symbol of its own, and not t, u or d, found '" + parameter.name + "'");
    }
    bounds_.emplace_back(Bound(field + ".lowest", parameter.lowest), Bound(field + ".highest", parameter.highest));
    names_.push_back(parameter.name);
  }

  /// For what needs psi and psi' only.
  [[nodiscard]] SymbolicGenerator generator(const Theta& theta) const { return {formula_, 1, theta, subject(theta)}; }

  [[nodiscard]] std::string subject(const Theta& theta) const {
    std::string values;
    for (std::size_t i = 0; i < theta.size(); ++i) {
      values += (values.empty() ? "" : ", ") + names_[i] + " = " + to_text(theta[i]);
    }
    return definition_.name + (values.empty() ? "" : " (" + values + ")");
  }

  FamilyDefinition definition_;
  std::vector<std::string> names_;
  std::vector<std::pair<Bound, Bound>> bounds_;
  std::shared_ptr<const GeneratorFormula> formula_;
};

using FormulaFamilyPtr = std::shared_ptr<const FormulaFamily>;

void add_tau(FamilyInfo& info, const FormulaFamilyPtr& family) {
  if (info.parameters.size() != 1) {
    info.tau = [family](const Theta& theta) { return family->tau(theta); };
    return;
  }
  const auto scale =
      std::make_shared<const TauScale>(family->domain(0, 2), [family](double theta) { return family->tau({theta}); });
  info.tau = [scale](const Theta& theta) { return scale->tau(theta.at(0)); };
  if (scale->monotone()) info.theta_from_tau = [scale](double tau) { return Theta{scale->theta(tau)}; };
}

void require_examples(const FamilyInfo& info) {
  for (std::size_t i = 0; i < info.examples.size(); ++i) {
    try {
      info.require_admissible(2, info.examples[i]);
    } catch (const std::logic_error& error) {
      throw std::invalid_argument("examples[" + std::to_string(i) + "]: " + error.what());
    }
  }
}

}  // namespace

FamilyInfo make_family(const FamilyDefinition& definition) {
  const auto family = std::make_shared<const FormulaFamily>(definition);
  FamilyInfo info{.name = definition.name,
                  .title = definition.title,
                  .psi = definition.psi,
                  .source = definition.source,
                  .parameters = {},
                  .examples = definition.examples,
                  .make_unchecked = [family](int dim, const Theta& theta) { return family->make(dim, theta); },
                  .tau = {},
                  .theta_from_tau = {},
                  .tails = [family](const Theta& theta) { return family->tails(theta); },
                  .definition = to_json(definition),
                  .dimensions = {2, kMaxDimension}};
  for (std::size_t i = 0; i < definition.parameters.size(); ++i) {
    info.parameters.push_back({definition.parameters[i].name, [family, i](int dim) { return family->domain(i, dim); }});
  }
  require_examples(info);
  add_tau(info, family);
  return info;
}

FamilyInfo formula_of(const FamilyInfo& family) {
  FamilyDefinition definition{.name = "formula",
                              .title = family.title,
                              .psi = family.psi,
                              .psi_inverse = {},
                              .source = family.source,
                              .parameters = {},
                              .examples = family.examples};
  for (const ParameterInfo& parameter : family.parameters) {
    definition.parameters.push_back({.name = parameter.name, .lowest = "-inf", .highest = "inf"});
  }
  const auto formula = std::make_shared<const FormulaFamily>(definition);
  FamilyInfo info = family;
  info.dimensions.highest = std::min(info.dimensions.highest, kMaxDimension);
  info.make_unchecked = [formula, rotation = family.rotation](int dim, const Theta& theta) -> CopulaPtr {
    CopulaPtr copula = formula->make(dim, theta);
    if (rotation.none()) return copula;
    return std::make_shared<Rotated>(std::move(copula), rotation.in(dim));
  };
  return info;
}

}  // namespace sklar::symbolic
