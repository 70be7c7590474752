#pragma once
/// Models of every kind: how they are named, and their tables.

#include <filesystem>
#include <string>
#include <vector>

#include "brdf/study/model_comparison.hpp"

namespace sklar::cli {

inline constexpr const char* kAllModels = "all";

/// @param models kAllModels, or names with commas. @throws as all_contenders and find_contenders.
[[nodiscard]] std::vector<brdf::Contender> parse_contenders(const std::string& models,
                                                            const std::vector<double>& budgets);

/// FOLDER/models.json, models.csv and models.md. @param all whether every model was asked for. @return the paths.
std::vector<std::filesystem::path> write_model_tables(const std::filesystem::path& folder,
                                                      const std::vector<brdf::ModelRow>& rows, bool all);

/// The means of each model, and what has failed.
void print_models(const std::vector<brdf::ModelRow>& rows);

}  // namespace sklar::cli
