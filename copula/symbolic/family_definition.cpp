#include "copula/symbolic/family_definition.hpp"

#include <algorithm>
#include <charconv>

#include "copula/json_fields.hpp"
#include "copula/listed.hpp"

namespace sklar::symbolic {

namespace {

using json::Json;

constexpr std::string_view kFormat = "sklar family";

void require_known_fields(const Json& object, const std::vector<std::string>& known) {
  if (!object.is_object()) throw std::invalid_argument("must be an object");
  for (const auto& entry : object.items()) {
    if (std::find(known.begin(), known.end(), entry.key()) != known.end()) continue;
    throw std::invalid_argument("unknown field '" + entry.key() + "'; allowed are " + listed(known));
  }
}

bool flag(const Json& object, const char* name) {
  if (!object.contains(name)) return true;
  const Json& value = json::field(object, name);
  if (!value.is_boolean()) {
    throw std::invalid_argument("field '" + std::string(name) + "' must be true or false, found " + value.dump());
  }
  return value.get<bool>();
}

std::string bound(const Json& object, const std::string& parameter, const char* name) {
  if (!object.contains(name)) {
    throw std::invalid_argument("unbounded parameter '" + parameter + "': field '" + name +
                                "' is missing; write a number, \"inf\", \"-inf\" or a formula in the dimension d such "
                                "as \"-1/(d-1)\"");
  }
  const Json& value = object[name];
  if (value.is_number()) return to_text(value.get<double>());
  if (value.is_string()) return value.get<std::string>();
  throw std::invalid_argument("field '" + std::string(name) +
                              "' must be a number, \"inf\", \"-inf\" or a formula in d, found " + value.dump());
}

/// A number where the text is one.
Json bound_to_json(const std::string& text) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || to_text(value) != text || text.find("inf") != std::string::npos)
    return text;
  return value;
}

ParameterDefinition parameter_from(const Json& object) {
  require_known_fields(object, {"name", "lowest", "highest", "lowest_included", "highest_included"});
  ParameterDefinition parameter;
  parameter.name = json::text(object, "name");
  parameter.lowest = bound(object, parameter.name, "lowest");
  parameter.highest = bound(object, parameter.name, "highest");
  parameter.lowest_included = flag(object, "lowest_included");
  parameter.highest_included = flag(object, "highest_included");
  return parameter;
}

/// convert(entry) of each entry; errors name its index.
template <class Convert>
void each_of(const Json& object, const char* name, const Convert& convert) {
  const Json& entries = json::array(object, name);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    try {
      convert(entries[i]);
    } catch (const std::logic_error& error) {
      throw std::invalid_argument(std::string(name) + "[" + std::to_string(i) + "]: " + error.what());
    }
  }
}

FamilyDefinition definition_from(const Json& object) {
  json::require_format(object, kFormat, kFamilyVersion);
  require_known_fields(
      object, {"format", "version", "name", "title", "psi", "psi_inverse", "source", "parameters", "examples"});
  FamilyDefinition definition;
  definition.name = json::text(object, "name");
  definition.title = json::text(object, "title");
  definition.psi = json::text(object, "psi");
  if (object.contains("psi_inverse")) definition.psi_inverse = json::text(object, "psi_inverse");
  definition.source = json::text(object, "source");
  each_of(object, "parameters", [&](const Json& entry) { definition.parameters.push_back(parameter_from(entry)); });
  each_of(object, "examples", [&](const Json& entry) {
    if (!entry.is_array()) throw std::invalid_argument("must be an array of numbers");
    definition.examples.push_back(json::numbers({{"theta", entry}}, "theta"));
  });
  return definition;
}

}  // namespace

std::string to_json(const FamilyDefinition& definition) {
  Json object = {{"format", kFormat},
                 {"version", kFamilyVersion},
                 {"name", definition.name},
                 {"title", definition.title},
                 {"psi", definition.psi}};
  if (!definition.psi_inverse.empty()) object["psi_inverse"] = definition.psi_inverse;
  object["source"] = definition.source;
  object["parameters"] = Json::array();
  for (const ParameterDefinition& parameter : definition.parameters) {
    object["parameters"].push_back({{"name", parameter.name},
                                    {"lowest", bound_to_json(parameter.lowest)},
                                    {"highest", bound_to_json(parameter.highest)},
                                    {"lowest_included", parameter.lowest_included},
                                    {"highest_included", parameter.highest_included}});
  }
  object["examples"] = definition.examples;
  return object.dump();
}

FamilyDefinition parse_definition(std::string_view json, std::string_view source) {
  return json::parse(json, source, definition_from);
}

}  // namespace sklar::symbolic
