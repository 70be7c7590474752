#pragma once
/// What `sklar tradeoff --brdf` writes.

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "brdf/study/model_tradeoff.hpp"
#include "copula/plot/plot.hpp"

namespace sklar::cli {

[[nodiscard]] std::string to_table(std::span<const brdf::ModelTradeoffRow> rows);
[[nodiscard]] std::string to_csv(std::span<const brdf::ModelTradeoffRow> rows, const std::string& material);
[[nodiscard]] nlohmann::ordered_json to_json(std::span<const brdf::ModelTradeoffRow> rows, const std::string& material);

/// Error against bytes and against nanoseconds: a colour a family, a line a mode, the models that no other beats in
/// both joined in black.
[[nodiscard]] plot::Page to_page(std::span<const brdf::ModelTradeoffRow> rows, const std::string& material);

}  // namespace sklar::cli
