#include "copula/json_fields.hpp"

#include <algorithm>

namespace sklar::json {

namespace {

[[noreturn]] void fail(const char* name, const char* expected) {
  throw std::invalid_argument("field '" + std::string(name) + "' must be " + expected);
}

/// Called by the parser at each step into a value; `depth` counts the values around it.
class Limits {
 public:
  bool operator()(int depth, Json::parse_event_t event, const Json& /*value*/) {
    constexpr int kDeepest = 64;
    constexpr int kMostFields = 10000;
    const auto level = static_cast<std::size_t>(depth);
    if (event == Json::parse_event_t::object_start || event == Json::parse_event_t::array_start) {
      if (depth >= kDeepest) throw std::invalid_argument("nests more than " + std::to_string(kDeepest) + " levels");
      fields_.resize(level + 1);
      fields_.push_back(0);
    }
    if (event == Json::parse_event_t::key && ++fields_.at(level) > kMostFields) {
      throw std::invalid_argument("has an object of more than " + std::to_string(kMostFields) + " fields");
    }
    return true;
  }

 private:
  std::vector<int> fields_;  ///< so far, of the open object at each depth
};

}  // namespace

void require_utf8(const char* what, std::string_view text) {
  try {
    (void)Json(text).dump();
  } catch (const Json::type_error&) {
    throw std::invalid_argument(std::string(what) + " is not UTF-8");
  }
}

Json document(std::string_view text) {
  try {
    return Json::parse(text, Limits());
  } catch (const Json::parse_error& error) {
    throw std::invalid_argument("is not valid JSON: byte " + std::to_string(error.byte));
  } catch (const Json::out_of_range&) {
    throw std::invalid_argument("holds a number that is beyond double");
  }
}

const Json& field(const Json& object, const char* name) {
  if (!object.is_object())
    throw std::invalid_argument("field '" + std::string(name) + "' looked for outside an object");
  const auto found = object.find(name);
  if (found == object.end()) throw std::invalid_argument("field '" + std::string(name) + "' is missing");
  return *found;
}

std::string text(const Json& object, const char* name) {
  const Json& value = field(object, name);
  if (!value.is_string()) fail(name, "a text");
  return value.get<std::string>();
}

double number(const Json& object, const char* name) {
  const Json& value = field(object, name);
  if (!value.is_number()) fail(name, "a number");
  return value.get<double>();
}

int integer(const Json& object, const char* name) {
  const Json& value = field(object, name);
  if (!value.is_number_integer() || value < 0 || value > 1'000'000) {
    throw std::invalid_argument("field '" + std::string(name) + "' must be a whole number in 0 to 1000000, found " +
                                value.dump());
  }
  return value.get<int>();
}

const Json& array(const Json& object, const char* name) {
  const Json& value = field(object, name);
  if (!value.is_array()) fail(name, "an array");
  return value;
}

std::vector<double> numbers(const Json& object, const char* name) {
  const Json& value = field(object, name);
  const bool valid =
      value.is_array() && std::all_of(value.begin(), value.end(), [](const Json& entry) { return entry.is_number(); });
  if (!valid) fail(name, "an array of numbers");
  return value.get<std::vector<double>>();
}

void require_format(const Json& document, std::string_view format, int newest) {
  if (!document.is_object() || !document.contains("format") || document["format"] != format) {
    throw std::invalid_argument("expected \"format\": \"" + std::string(format) + "\"");
  }
  const int version = integer(document, "version");
  if (version < 1 || version > newest) {
    throw std::invalid_argument("has version " + std::to_string(version) + "; this program reads versions 1 to " +
                                std::to_string(newest));
  }
}

}  // namespace sklar::json
