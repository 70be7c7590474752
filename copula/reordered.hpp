#pragma once
/// Copulas with their coordinates in another order.

#include <span>

#include "copula/copula.hpp"

namespace sklar {

/// The copula of (U_order[0], U_order[1], ..), as exact as that of U. Archimedean copulas are exchangeable: any order
/// is the same copula; of a rotated copula the reflections move along, of a mixture each component.
/// @param order   each coordinate, from 0, once.
/// @throws std::invalid_argument for another order, and for a copula of another kind in an order not its own.
[[nodiscard]] CopulaPtr reordered(const CopulaPtr& copula, std::span<const int> order);

}  // namespace sklar
