#pragma once
/// Whether a formula is a generator for the parameters and the dimension asked for.

#include "copula/symbolic/symbolic_generator.hpp"

namespace sklar::symbolic {

/// Arguments at which signs are checked: where psi has set levels from near 1 to near 0, and evenly in log t from
/// before the first of them to far beyond the last.
inline constexpr int kCheckedPoints = 28;

/// Checks psi(0) = 1, the limit 0, and (-1)^k psi^(k)(t) >= 0 for k = 0..dim at kCheckedPoints arguments. A necessary
/// condition, not a sufficient one. Signs that no number type resolves count as right.
/// @param subject opens the message, as in "gumbel: theta = 2".
/// @throws std::domain_error naming what is violated: dimension, order, t and the value there.
void require_generator(const SymbolicGenerator& generator, int dim, const std::string& subject);

}  // namespace sklar::symbolic
