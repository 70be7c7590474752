#include "copula/inference/model_io.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "copula/error.hpp"
#include "copula/file.hpp"

namespace sklar {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kFormat = "sklar copula";

const FamilyInfo& find_family(std::string_view name, std::span<const FamilyInfo> families) {
  std::string known;
  for (const FamilyInfo& family : families) {
    if (family.name == name) return family;
    known += (known.empty() ? "" : ", ") + family.name;
  }
  throw std::invalid_argument("unknown family '" + std::string(name) + "'; known families: " + known);
}

Json to_json_value(const HistogramMarginal& margin) {
  return {{"kind", "histogram"}, {"edges", margin.edges()}, {"masses", margin.masses()}};
}

Json to_json_value(const EmpiricalMarginal& margin) {
  return {{"kind", "empirical"}, {"values", margin.sorted()}};
}

const Json& field(const Json& object, const char* name) {
  const auto found = object.find(name);
  if (found == object.end()) throw std::invalid_argument("field '" + std::string(name) + "' is missing");
  return *found;
}

std::string text(const Json& object, const char* name) {
  const Json& value = field(object, name);
  if (!value.is_string()) throw std::invalid_argument("field '" + std::string(name) + "' must be a text");
  return value.get<std::string>();
}

std::vector<double> numbers(const Json& object, const char* name) {
  const Json& value = field(object, name);
  const bool valid =
      value.is_array() && std::all_of(value.begin(), value.end(), [](const Json& entry) { return entry.is_number(); });
  if (!valid) throw std::invalid_argument("field '" + std::string(name) + "' must be an array of numbers");
  return value.get<std::vector<double>>();
}

int integer(const Json& object, const char* name) {
  const Json& value = field(object, name);
  if (!value.is_number_integer() || value < 0 || value > 1'000'000) {
    throw std::invalid_argument("field '" + std::string(name) + "' must be a whole number in 0 to 1000000, found " +
                                value.dump());
  }
  return value.get<int>();
}

StoredMarginal margin_from(const Json& object) {
  const auto kind = text(object, "kind");
  if (kind == "histogram") {
    return HistogramMarginal(numbers(object, "edges"), numbers(object, "masses"));
  }
  if (kind == "empirical") {
    const auto values = numbers(object, "values");
    return EmpiricalMarginal(Eigen::Map<const Column>(values.data(), static_cast<Index>(values.size())));
  }
  throw std::invalid_argument("unknown kind '" + kind + "'; known kinds: histogram, empirical");
}

void require_format(const Json& json) {
  if (!json.is_object() || !json.contains("format") || json["format"] != kFormat) {
    throw std::invalid_argument("is not a copula model: expected \"format\": \"" + std::string(kFormat) + "\"");
  }
  const int version = integer(json, "version");
  if (version < 1 || version > kModelVersion) {
    throw std::invalid_argument("has version " + std::to_string(version) + "; this program reads versions 1 to " +
                                std::to_string(kModelVersion));
  }
}

void require_margins(const CopulaModel& model) {
  if (model.margins.empty() || model.margins.size() == static_cast<std::size_t>(model.dim)) return;
  throw std::invalid_argument("needs " + std::to_string(model.dim) + " margins or none, got " +
                              std::to_string(model.margins.size()));
}

CopulaModel model_from(const Json& json, std::span<const FamilyInfo> families) {
  require_format(json);
  CopulaModel model{
      .family = text(json, "family"), .dim = integer(json, "dim"), .theta = numbers(json, "theta"), .margins = {}};
  find_family(model.family, families).require_admissible(model.dim, model.theta);
  const Json& margins = field(json, "margins");
  if (!margins.is_array()) throw std::invalid_argument("field 'margins' must be an array");
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
  Json json = {{"format", kFormat}, {"version", kModelVersion}, {"family", model.family},
               {"dim", model.dim},  {"theta", model.theta},     {"margins", Json::array()}};
  for (const StoredMarginal& margin : model.margins) {
    json["margins"].push_back(std::visit([](const auto& value) { return to_json_value(value); }, margin));
  }
  return json.dump() + "\n";
}

CopulaModel parse_model(std::string_view json, std::string_view source, std::span<const FamilyInfo> families) {
  try {
    return model_from(Json::parse(json), families);
  } catch (const Json::parse_error& error) {
    throw FileError(source, "is not valid JSON: byte " + std::to_string(error.byte));
  } catch (const std::logic_error& error) {
    throw FileError(source, error.what());
  }
}

CopulaModel read_model(const std::filesystem::path& path, std::span<const FamilyInfo> families) {
  const std::string json = read_file(path);
  return parse_model(json, path.string(), families);
}

CopulaPtr make_copula(const CopulaModel& model, std::span<const FamilyInfo> families) {
  return find_family(model.family, families).make(model.dim, model.theta);
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
