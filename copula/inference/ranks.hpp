#pragma once
/// Values in order, ties together; internal to the library's sources.

#include <vector>

#include "copula/types.hpp"

namespace sklar {

/// The rows by rising value. Precondition: no NaN.
[[nodiscard]] std::vector<Index> sorted_order(const ColumnRef& x);

/// Calls body(first, last) for every run of equal values of x in the sorted order.
template <class Body>
void for_each_run(const ColumnRef& x, const std::vector<Index>& order, Body body) {
  for (std::size_t first = 0; first < order.size();) {
    std::size_t last = first + 1;
    while (last < order.size() && x[order[last]] == x[order[first]]) ++last;
    body(first, last);
    first = last;
  }
}

}  // namespace sklar
