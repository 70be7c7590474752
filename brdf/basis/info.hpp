#pragma once
/// BasisInfo: the value by which everything outside a basis model's own file knows the model.

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "brdf/brdf.hpp"
#include "brdf/data/measured_table.hpp"

namespace sklar::brdf {

/// What a basis model is fitted to. Masked cells take no part.
struct BasisData {
  const MeasuredTable& table;
  std::span<const std::shared_ptr<const MeasuredTable>> others = {};  ///< for models that learn from a set of materials
  std::function<void(std::string_view)> on_message = {};              ///< told what the caller should know of a fit
};

/// The value by which everything outside a model's own file knows the model.
struct BasisInfo {
  std::string name;             ///< registry key, lower case
  std::string title;            ///< as printed
  std::string source;           ///< reference
  std::size_t learns_from = 0;  ///< how many other tables a fit needs at least

  std::function<BrdfPtr(const BasisData& data, double max_bytes)> fit_unchecked;  ///< fit, given sound data

  /// The model of the table within a budget: bytes() <= max_bytes, unless the model has one size only, which
  /// on_message is then told. @param max_bytes > 0, infinity for no limit.
  /// @throws std::invalid_argument if the table or one of the others fails require_table, if there are fewer others
  /// than the model needs, one is missing or is the table itself, if the budget is not above 0 or too small for the
  /// model.
  [[nodiscard]] BrdfPtr fit(const BasisData& data, double max_bytes) const;
};

/// @throws std::invalid_argument naming model, budget and need if `needed` bytes are more than max_bytes.
void require_budget(std::string_view model, double needed, double max_bytes);

}  // namespace sklar::brdf
