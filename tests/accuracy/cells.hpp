#pragma once
/// Random questions to a copula: parameters, points and quantities of every size.

#include <string>
#include <vector>

#include "copula/family.hpp"
#include "copula/random.hpp"

namespace sklar::accuracy {

enum class Quantity { log_pdf, log_cdf, h, h_upper, h_inv, h_inv_upper };
inline constexpr int kQuantities = 6;

[[nodiscard]] const char* to_text(Quantity quantity);

struct Cell {
  Quantity quantity;
  Theta theta;
  std::vector<double> u;  ///< the last is p where the quantity is an inverse

  [[nodiscard]] int dim() const { return static_cast<int>(u.size()); }
};

/// A parameter at a log-uniform distance, 1e-10 to 1e4, from an end of the domain or from 0, or 1e-15 to 1 from a
/// finite upper end; coordinates uniform, 1e-300 to 1, 1e-16 to 1 from 1, or near another coordinate.
/// @param dim 2 or more. @param largest of |theta|.
[[nodiscard]] Cell random_cell(const FamilyInfo& family, int dim, double largest, Rng& rng);

/// "ordinary": all u within 1e-6 of neither end and |tau| from 0.01 to 0.95; else what is extreme: "theta", "u",
/// "both".
[[nodiscard]] std::string region(const FamilyInfo& family, const Cell& cell);

}  // namespace sklar::accuracy
