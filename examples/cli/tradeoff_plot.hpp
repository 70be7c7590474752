#pragma once
/// The picture of `sklar tradeoff`.

#include <span>
#include <string>

#include "copula/plot/plot.hpp"
#include "copula/study/tradeoff.hpp"

namespace sklar::cli {

/// Error against nanoseconds a row: a panel a quantity, a colour a family, a marker a level at its largest error, with
/// a line down to its median. Families without parameters are left out: they have nothing to compute.
[[nodiscard]] plot::Page tradeoff_page(std::span<const TradeoffRow> rows, const std::string& title);

}  // namespace sklar::cli
