#pragma once
/// The trade of speed for accuracy, measured: what a value costs at each level of accuracy, and how far it is from the
/// exact one.

#include <cstdint>
#include <string>
#include <vector>

#include "copula/family.hpp"
#include "copula/study/value_errors.hpp"

namespace sklar {

/// One quantity of one family at one level.
struct TradeoffRow {
  std::string family;
  Theta theta;
  std::string quantity;  ///< "log_pdf", "h", "h_inv"
  std::string level;     ///< "fast", "standard": see Accuracy; "symbolic": standard from the text of psi alone; "exact"
  double ns;             ///< a row, in a batch of all rows on one thread; see seconds_per_call
  ValueErrors errors;    ///< against twice the digits of the level "exact"; of log_pdf as a logarithm
};

/// What is measured.
struct TradeoffOptions {
  int dim = 2;
  Index rows = 1000;  ///< points drawn from the copula
  std::uint64_t seed = 1;
  int digits = 50;  ///< of the level "exact"
};

/// The parameters whose Kendall's tau is 1/2, or three quarters of the largest where that is not attained. Where tau
/// has no inverse: those of the examples with the nearest tau below 1/2, else the first.
/// @throws as FamilyInfo::require_dimension; std::invalid_argument for a family without examples.
[[nodiscard]] Theta medium_theta(const FamilyInfo& family, int dim);

/// All quantities at all levels that the family has, quantity by quantity, at medium_theta.
/// @throws as medium_theta and Copula::sample.
[[nodiscard]] std::vector<TradeoffRow> measure_tradeoff(const FamilyInfo& family, const TradeoffOptions& options);

}  // namespace sklar
