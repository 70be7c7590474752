#include "copula/inference/model_io.hpp"

#include "copula/error.hpp"
#include "copula/file.hpp"
#include "copula/json_fields.hpp"
#include "copula/symbolic/formula_family.hpp"

namespace sklar {
namespace {

using json::Json;

constexpr std::string_view kFormat = "sklar copula";

const FamilyInfo& find_family(std::string_view name, std::span<const FamilyInfo> families) {
  std::string known;
  for (const FamilyInfo& family : families) {
    if (family.name == name) return family;
    known += (known.empty() ? "" : ", ") + family.name;
  }
  throw std::invalid_argument("unknown family '" + std::string(name) + "'; known families: " + known);
}

FamilyInfo family_of(const CopulaModel& model, std::span<const FamilyInfo> families) {
  if (model.definition.empty()) return find_family(model.family, families);
  return symbolic::make_family(symbolic::parse_definition(model.definition, "definition of the family"));
}

Json to_json_value(const HistogramMarginal& margin) {
  return {{"kind", "histogram"}, {"edges", margin.edges()}, {"masses", margin.masses()}};
}

Json to_json_value(const EmpiricalMarginal& margin) {
  return {{"kind", "empirical"}, {"values", margin.sorted()}};
}

StoredMarginal margin_from(const Json& object) {
  const auto kind = json::text(object, "kind");
  if (kind == "histogram") {
    return HistogramMarginal(json::numbers(object, "edges"), json::numbers(object, "masses"));
  }
  if (kind == "empirical") {
    const auto values = json::numbers(object, "values");
    return EmpiricalMarginal(Eigen::Map<const Column>(values.data(), static_cast<Index>(values.size())));
  }
  throw std::invalid_argument("unknown kind '" + kind + "'; known kinds: histogram, empirical");
}

void require_margins(const CopulaModel& model) {
  if (model.margins.empty() || model.margins.size() == static_cast<std::size_t>(model.dim)) return;
  throw std::invalid_argument("needs " + std::to_string(model.dim) + " margins or none, got " +
                              std::to_string(model.margins.size()));
}

CopulaModel model_from(const Json& json, std::span<const FamilyInfo> families) {
  json::require_format(json, kFormat, kModelVersion);
  const bool defined = json::field(json, "family").is_object();
  CopulaModel model{.family = json::text(defined ? json["family"] : json, defined ? "name" : "family"),
                    .dim = json::integer(json, "dim"),
                    .theta = json::numbers(json, "theta"),
                    .margins = {},
                    .definition = defined ? json["family"].dump() : ""};
  family_of(model, families).require_admissible(model.dim, model.theta);
  const Json& margins = json::array(json, "margins");
  for (std::size_t i = 0; i < margins.size(); ++i) {
    try {
      model.margins.push_back(margin_from(margins[i]));
    } catch (const std::logic_error& error) {
      throw std::invalid_argument("margins[" + std::to_string(i) + "]: " + error.what());
    }
  }
  require_margins(model);
  return model;
}

}  // namespace

std::string to_json(const CopulaModel& model) {
  const Json family = model.definition.empty() ? Json(model.family) : Json::parse(model.definition);
  Json json = {{"format", kFormat}, {"version", kModelVersion}, {"family", family},
               {"dim", model.dim},  {"theta", model.theta},     {"margins", Json::array()}};
  for (const StoredMarginal& margin : model.margins) {
    json["margins"].push_back(std::visit([](const auto& value) { return to_json_value(value); }, margin));
  }
  return json.dump() + "\n";
}

CopulaModel parse_model(std::string_view json, std::string_view source, std::span<const FamilyInfo> families) {
  return json::parse(json, source, [&](const Json& document) { return model_from(document, families); });
}

CopulaModel read_model(const std::filesystem::path& path, std::span<const FamilyInfo> families) {
  const std::string json = read_file(path);
  return parse_model(json, path.string(), families);
}

CopulaPtr make_copula(const CopulaModel& model, std::span<const FamilyInfo> families) {
  return family_of(model, families).make(model.dim, model.theta);
}

JointDistribution make_joint(const CopulaModel& model, std::span<const FamilyInfo> families) {
  std::vector<std::shared_ptr<const Marginal>> margins;
  for (const StoredMarginal& margin : model.margins) {
    margins.push_back(std::visit(
        [](const auto& value) -> std::shared_ptr<const Marginal> {
          return std::make_shared<std::decay_t<decltype(value)>>(value);
        },
        margin));
  }
  return {std::move(margins), make_copula(model, families)};
}

}  // namespace sklar
