#pragma once
/// The page of `sklar copula fit`.

#include <span>
#include <string>
#include <vector>

#include "copula/inference/fit.hpp"

namespace sklar::cli {

/// What was fitted to.
struct FitReport {
  std::string margins;               ///< as the option names them
  std::vector<std::string> columns;  ///< names
  const Points& u;                   ///< n x d, what the families were fitted to
};

/// Families with figures, pairs of columns with contours of the fitted densities, and Kendall distributions. Of more
/// than 2000 rows the plots show 2000, rows floor(i n / 2000) from 0.
/// @param families those of the results, in any order. @throws FileError
void write_fit_report(const std::string& path, const FitReport& report, std::span<const FamilyInfo* const> families,
                      std::span<const FitResult> results);

}  // namespace sklar::cli
