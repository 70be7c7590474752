#include "copula/inference/model_io.hpp"

#include <algorithm>

#include "copula/error.hpp"
#include "copula/file.hpp"
#include "copula/json_fields.hpp"
#include "copula/listed.hpp"
#include "copula/mixture.hpp"
#include "copula/rotated_family.hpp"
#include "copula/symbolic/formula_family.hpp"

namespace sklar {
namespace {

using json::Json;

constexpr std::string_view kFormat = "sklar copula";
constexpr int kMostStored = 1000;  // dimensions; what some domains and copulas take grows with their square

FamilyInfo family_from(const Json& json, std::string_view source, std::span<const FamilyInfo> families);

FamilyInfo family_named(std::string_view name, std::span<const FamilyInfo> families) {
  const RotatedName parts = split_rotation(name);
  const FamilyInfo& base = find_family(parts.base, families);
  return parts.rotation ? rotated_family(base, Rotation(*parts.rotation)) : base;
}

FamilyInfo family_of(const ModelComponent& component, std::span<const FamilyInfo> families) {
  if (component.definition.empty()) return family_named(component.family, families);
  return family_from_json(component.definition, "definition of the family", families);
}

Json to_json_value(const HistogramMarginal& margin) {
  return {{"kind", "histogram"}, {"edges", margin.edges()}, {"masses", margin.masses()}};
}

/// Adds the weights of data, if any.
Json with_weights(Json json, const std::vector<double>& weights) {
  if (!weights.empty()) json["weights"] = weights;
  return json;
}

Json to_json_value(const EmpiricalMarginal& margin) {
  return with_weights({{"kind", "empirical"}, {"values", margin.sorted()}}, margin.weights());
}

Json to_json_value(const KernelMarginal& margin) {
  return with_weights({{"kind", "kernel"}, {"values", margin.values()}, {"bandwidth", margin.bandwidth()}},
                      margin.weights());
}

Json to_json_value(const NormalMarginal& margin) {
  const auto [mean, sd] = margin.parameters();
  return {{"kind", "normal"}, {"mean", mean}, {"sd", sd}};
}

Json to_json_value(const GammaMarginal& margin) {
  const auto [shape, scale] = margin.parameters();
  return {{"kind", "gamma"}, {"shape", shape}, {"scale", scale}};
}

Json to_json_value(const BetaMarginal& margin) {
  const auto [a, b] = margin.parameters();
  const auto [lowest, highest] = margin.support();
  return {{"kind", "beta"}, {"a", a}, {"b", b}, {"lowest", lowest}, {"highest", highest}};
}

Column column_of(const Json& object, const char* name) {
  const std::vector<double> values = json::numbers(object, name);
  return Eigen::Map<const Column>(values.data(), static_cast<Index>(values.size()));
}

Column weights_of(const Json& object) {
  return object.contains("weights") ? column_of(object, "weights") : Column();
}

StoredMarginal margin_from(const Json& object) {
  const auto kind = json::text(object, "kind");
  const auto number = [&](const char* name) { return json::number(object, name); };
  if (kind == "histogram") {
    return HistogramMarginal(json::numbers(object, "edges"), json::numbers(object, "masses"));
  }
  if (kind == "empirical") return EmpiricalMarginal(column_of(object, "values"), weights_of(object));
  if (kind == "kernel") return KernelMarginal(column_of(object, "values"), number("bandwidth"), weights_of(object));
  if (kind == "normal") return NormalMarginal(number("mean"), number("sd"));
  if (kind == "gamma") return GammaMarginal(number("shape"), number("scale"));
  if (kind == "beta") return BetaMarginal(number("a"), number("b"), number("lowest"), number("highest"));
  throw std::invalid_argument("unknown kind '" + kind +
                              "'; known kinds: histogram, empirical, kernel, normal, gamma, beta");
}

void require_margins(const CopulaModel& model) {
  if (model.margins.empty() || model.margins.size() == static_cast<std::size_t>(model.dim)) return;
  throw std::invalid_argument("needs " + std::to_string(model.dim) + " margins or none, got " +
                              std::to_string(model.margins.size()));
}

void require_columns(const CopulaModel& model) {
  if (model.columns.empty()) return;
  if (model.columns.size() != static_cast<std::size_t>(model.dim)) {
    throw std::invalid_argument("needs the names of " + std::to_string(model.dim) + " columns or none, got " +
                                std::to_string(model.columns.size()));
  }
  for (auto name = model.columns.begin(); name != model.columns.end(); ++name) {
    json::require_utf8("the name of a column", *name);
    if (std::find(model.columns.begin(), name, *name) != name) {
      throw std::invalid_argument("two columns are named '" + *name + "'");
    }
  }
}

/// A component and what its family is: a definition is read once, however deep models stand in models.
struct Part {
  ModelComponent component;
  FamilyInfo family;
};

CopulaPtr copula_of(int dim, const std::vector<Part>& parts) {
  std::vector<CopulaPtr> copulas;
  std::vector<double> weights;
  for (const auto& [component, family] : parts) {
    copulas.push_back(family.make(dim, component.theta));
    weights.push_back(component.weight);
  }
  if (copulas.size() == 1 && weights.front() == 1) return copulas.front();
  return std::make_shared<Mixture>(std::move(copulas), std::move(weights));
}

Part component_from(const Json& json, int dim, std::string_view source, std::span<const FamilyInfo> families) {
  const Json& family = json::field(json, "family");
  const FamilyInfo info =
      family.is_object() ? family_from(family, source, families) : family_named(json::text(json, "family"), families);
  ModelComponent component{.family = info.name, .theta = json::numbers(json, "theta"), .definition = info.definition};
  info.require_admissible(dim, component.theta);
  return {std::move(component), info};
}

/// convert(entry) of each entry of an array, which errors name.
template <class Convert>
auto each_of(const Json& json, const char* name, const Convert& convert) {
  const Json& array = json::array(json, name);
  std::vector<decltype(convert(array))> values;
  for (std::size_t i = 0; i < array.size(); ++i) {
    try {
      values.push_back(convert(array[i]));
    } catch (const std::logic_error& error) {
      throw std::invalid_argument(std::string(name) + "[" + std::to_string(i) + "]: " + error.what());
    }
  }
  return values;
}

std::string text_of(const Json& json) {
  if (!json.is_string()) throw std::invalid_argument("must be a text");
  return json.get<std::string>();
}

std::vector<Part> parts_from(const Json& json, int dim, std::string_view source, std::span<const FamilyInfo> families) {
  if (!json.contains("components")) return {component_from(json, dim, source, families)};
  if (json.contains("family") || json.contains("theta")) {
    throw std::invalid_argument("has the field 'components', so 'family' and 'theta' belong into its entries");
  }
  return each_of(json, "components", [&](const Json& entry) {
    Part part = component_from(entry, dim, source, families);
    part.component.weight = json::number(entry, "weight");
    return part;
  });
}

void require_weights(const std::vector<Part>& parts) {
  if (parts.empty()) throw std::invalid_argument("a model needs one component or more, got none");
  std::vector<double> weights(parts.size());
  std::transform(parts.begin(), parts.end(), weights.begin(), [](const Part& part) { return part.component.weight; });
  Mixture::require_weights(weights, parts.size());
}

struct ReadModel {
  CopulaModel model;
  std::vector<Part> parts;  ///< its components
};

ReadModel model_from(const Json& json, std::string_view source, std::span<const FamilyInfo> families) {
  json::require_format(json, kFormat, kModelVersion);
  CopulaModel model{.dim = json::integer(json, "dim"), .components = {}};
  if (model.dim > kMostStored) {
    throw std::invalid_argument("field 'dim' must be at most " + std::to_string(kMostStored) + ", found " +
                                std::to_string(model.dim));
  }
  std::vector<Part> parts = parts_from(json, model.dim, source, families);
  for (const Part& part : parts) model.components.push_back(part.component);
  model.margins = each_of(json, "margins", margin_from);
  if (json.contains("name")) model.name = json::text(json, "name");
  if (json.contains("columns")) model.columns = each_of(json, "columns", text_of);
  require_margins(model);
  require_columns(model);
  if (json.contains("components")) require_weights(parts);
  return {std::move(model), std::move(parts)};
}

Json family_json(const ModelComponent& component) {
  return component.definition.empty() ? Json(component.family) : Json::parse(component.definition);
}

bool needs_version_2(const CopulaModel& model) {
  if (model.components.size() != 1 || !model.name.empty()) return true;
  const ModelComponent& only = model.components.front();
  return split_rotation(only.family).rotation.has_value() ||
         (!only.definition.empty() && !Json::parse(only.definition).contains("psi"));
}

bool needs_version_3(const StoredMarginal& margin) {
  if (const auto* ranks = std::get_if<EmpiricalMarginal>(&margin)) return !ranks->weights().empty();
  return !std::holds_alternative<HistogramMarginal>(margin);
}

int version_of(const CopulaModel& model) {
  if (!model.columns.empty()) return 4;
  if (std::any_of(model.margins.begin(), model.margins.end(), needs_version_3)) return 3;
  return needs_version_2(model) ? 2 : 1;
}

std::string title_of(const CopulaModel& model) {
  if (model.components.size() == 1) return model.components.front().family + " with its parameters";
  return "Mixture of " + listed(model.components, &ModelComponent::family);
}

FamilyInfo family_of_model(ReadModel&& read, std::string_view source) {
  auto& [model, parts] = read;
  model.margins.clear();
  model.columns.clear();
  if (model.name.empty()) model.name = source;
  double total = 0;
  for (const ModelComponent& component : model.components) total += component.weight;
  double tau = 0;
  TailDependence tails{0, 0};
  for (const auto& [component, family] : parts) {
    const TailDependence part = family.tails(component.theta);
    const double share = component.weight / total;
    tau = parts.size() == 1 ? family.tau(component.theta) : std::numeric_limits<double>::quiet_NaN();
    tails = {tails.lower + share * part.lower, tails.upper + share * part.upper};
  }
  const auto shared = std::make_shared<const std::vector<Part>>(std::move(parts));
  return {.name = model.name,
          .title = title_of(model),
          .psi = "",
          .source = "stored copula",
          .parameters = {},
          .examples = {Theta{}},
          .make_unchecked = [dim = model.dim, shared](int, const Theta&) { return copula_of(dim, *shared); },
          .tau = [tau](const Theta&) { return tau; },
          .theta_from_tau = {},
          .tails = [tails](const Theta&) { return tails; },
          .definition = to_json(model),
          .dimensions = {model.dim, model.dim}};
}

FamilyInfo family_from(const Json& json, std::string_view source, std::span<const FamilyInfo> families) {
  if (json.is_object() && json.contains("rotation")) {
    return rotated_family(family_from(json::field(json, "family"), source, families),
                          Rotation(json::text(json, "rotation")));
  }
  if (json.is_object() && json.contains("format") && json["format"] == kFormat) {
    return family_of_model(model_from(json, source, families), source);
  }
  return symbolic::make_family(symbolic::parse_definition(json.dump(), source));
}

}  // namespace

std::string to_json(const CopulaModel& model) {
  require_columns(model);
  Json json = {{"format", kFormat}, {"version", version_of(model)}};
  if (!model.name.empty()) json["name"] = model.name;
  if (model.components.size() == 1) {
    const ModelComponent& only = model.components.front();
    json.update({{"family", family_json(only)}, {"dim", model.dim}, {"theta", only.theta}});
  } else {
    json.update({{"dim", model.dim}, {"components", Json::array()}});
    for (const ModelComponent& part : model.components) {
      json["components"].push_back({{"weight", part.weight}, {"family", family_json(part)}, {"theta", part.theta}});
    }
  }
  if (!model.columns.empty()) json["columns"] = model.columns;
  json["margins"] = Json::array();
  for (const StoredMarginal& margin : model.margins) {
    json["margins"].push_back(std::visit([](const auto& value) { return to_json_value(value); }, margin));
  }
  return json.dump() + "\n";
}

CopulaModel parse_model(std::string_view json, std::string_view source, std::span<const FamilyInfo> families) {
  return json::parse(json, source, [&](const Json& document) { return model_from(document, source, families).model; });
}

CopulaModel read_model(const std::filesystem::path& path, std::span<const FamilyInfo> families) {
  const std::string json = read_file(path);
  return parse_model(json, path.string(), families);
}

CopulaPtr make_copula(const CopulaModel& model, std::span<const FamilyInfo> families) {
  if (model.components.empty()) throw std::invalid_argument("a model needs one component or more, got none");
  std::vector<Part> parts;
  for (const ModelComponent& component : model.components) parts.push_back({component, family_of(component, families)});
  return copula_of(model.dim, parts);
}

FamilyInfo family_from_json(std::string_view json, std::string_view source, std::span<const FamilyInfo> families) {
  return json::parse(json, source, [&](const Json& document) { return family_from(document, source, families); });
}

JointDistribution make_joint(const CopulaModel& model, std::span<const FamilyInfo> families) {
  std::vector<std::shared_ptr<const Marginal>> margins;
  for (const StoredMarginal& margin : model.margins) margins.push_back(share(margin));
  return {std::move(margins), make_copula(model, families)};
}

}  // namespace sklar
