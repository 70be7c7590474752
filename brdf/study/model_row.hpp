#pragma once
/// A row of a comparison of models as a file of its own.

#include <string>
#include <string_view>

#include "brdf/study/model_comparison.hpp"

namespace sklar::brdf {

/// The newest version written and read.
inline constexpr int kModelRowVersion = 2;

/// One row as a JSON document, all digits: {"format": "sklar-model-comparison", "version": 1, ..} with the names of
/// ModelRow; version 2 where it has inputs.
[[nodiscard]] std::string to_json(const ModelRow& row);

/// The row of such a document. @param source names it in errors. @throws FileError for anything wrong with the text.
[[nodiscard]] ModelRow model_row_from_json(std::string_view text, std::string_view source);

}  // namespace sklar::brdf
