#pragma once
/// A real number whose width is chosen at run time, by a WorkingPrecision.

#include <ostream>

#include "copula/big_float.hpp"

namespace sklar {

inline std::ostream& operator<<(std::ostream& out, const BigFloat& x) {
  return out << to_text(x, 20);
}

namespace test {
using Digits = BigFloat;
}

}  // namespace sklar
