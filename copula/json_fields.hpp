#pragma once
/// Fields of a JSON document, checked. Every failure is an std::invalid_argument that names the field and what was
/// found; parse turns it into a FileError. Include from .cpp files alone.

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "copula/error.hpp"

namespace sklar::json {

/// The fields keep their order.
using Json = nlohmann::ordered_json;

/// A field of an object, of the type that the name says. @throws std::invalid_argument naming the field: missing, or of
/// another type.
[[nodiscard]] const Json& field(const Json& object, const char* name);
[[nodiscard]] std::string text(const Json& object, const char* name);
[[nodiscard]] double number(const Json& object, const char* name);
[[nodiscard]] int integer(const Json& object, const char* name);  ///< 0 to 1000000
[[nodiscard]] const Json& array(const Json& object, const char* name);
[[nodiscard]] std::vector<double> numbers(const Json& object, const char* name);

/// The document must say "format": format and "version": 1 to newest.
void require_format(const Json& document, std::string_view format, int newest);

/// @throws std::invalid_argument naming `what` unless the text is UTF-8, as those of JSON are.
void require_utf8(const char* what, std::string_view text);

/// The value of a text. What handles it may recurse and search the fields of an object one by one: at most 64 levels,
/// at most 10000 fields in an object. @throws std::invalid_argument for more, for what is not JSON (naming the byte)
/// and for a number beyond double.
[[nodiscard]] Json document(std::string_view text);

/// convert(document(text)). @param source names the text in errors. @throws FileError for anything wrong with the text.
template <class Convert>
[[nodiscard]] auto parse(std::string_view text, std::string_view source, const Convert& convert) {
  try {
    return convert(document(text));
  } catch (const std::logic_error& error) {
    throw FileError(source, error.what());
  }
}

}  // namespace sklar::json
