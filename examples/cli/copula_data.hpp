#pragma once
/// The sample that `copula fit`, `test` and `plot` read, and the margins it is given.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "copula/inference/margin_fit.hpp"

namespace sklar::cli {

struct DataOptions {
  std::string path;
  std::string columns;  ///< names; empty for all but the weights
  std::string weights;  ///< name of a column; empty for none
  bool drop = false;    ///< rows with missing values
};

struct Sample {
  std::string path;
  std::vector<std::string> names{};  ///< d columns
  Points x{};                        ///< n x d, finite
  Column weights{};                  ///< n frequencies, or none
  std::vector<Index> lines;          ///< of the rows in the file
  Index dropped;                     ///< rows left out

  [[nodiscard]] double total_weight() const;
};

/// Adds FILE, --columns and --missing.
void add_data_options(CLI::App& command, DataOptions& options);

/// @throws FileError naming line and column of a bad field, counting missing values unless they are dropped.
[[nodiscard]] Sample read_sample(const DataOptions& options);

inline constexpr const char* kMarginsHelp =
    "empirical: ranks; kernel, normal, gamma, beta, beta:LOW:HIGH: a density; several, separated by commas: one a "
    "column; "
    "none: the columns are in (0,1) already";

/// What is wrong with the text of --margins; empty if nothing.
[[nodiscard]] std::string check_margins(const std::string& text);

/// One margin a column, none for "none". @throws std::invalid_argument for another number of margins than columns,
/// FileError naming line and column of a value outside the support of its margin.
[[nodiscard]] std::vector<MarginSpec> margins_for(const std::string& text, const Sample& sample);

}  // namespace sklar::cli
