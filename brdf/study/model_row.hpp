#pragma once
/// A row of a comparison of models as a file of its own.

#include <string>
#include <string_view>

#include "brdf/study/model_comparison.hpp"

namespace sklar::brdf {

/// One row as a JSON document, all digits.
[[nodiscard]] std::string to_json(const ModelRow& row);

/// The row of such a document. @param source names it in errors. @throws FileError for anything wrong with the text.
[[nodiscard]] ModelRow model_row_from_json(std::string_view text, std::string_view source);

}  // namespace sklar::brdf
