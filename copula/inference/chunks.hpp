#pragma once
/// Sums over rows in chunks; internal to the library's sources, as it needs oneTBB.

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <vector>

#include "copula/inference/objective.hpp"

namespace sklar {

/// The sum of body(first row, number of rows) over all chunks, added up in the order of the rows, so that it does not
/// depend on the number of threads. @param zero the sum of no rows.
template <class Sum, class Body>
Sum sum_over_chunks(Index rows, const Chunking& chunking, const Sum& zero, const Body& body) {
  const Index chunks = (rows + chunking.rows - 1) / chunking.rows;
  std::vector<Sum> parts(static_cast<std::size_t>(chunks), zero);
  const auto work = [&](Index chunk) {
    const Index first = chunk * chunking.rows;
    parts[static_cast<std::size_t>(chunk)] = body(first, std::min(chunking.rows, rows - first));
  };
  if (chunking.parallel && chunks > 1) {
    oneapi::tbb::parallel_for(Index{0}, chunks, work);
  } else {
    for (Index chunk = 0; chunk < chunks; ++chunk) work(chunk);
  }
  Sum sum = zero;
  for (const Sum& part : parts) sum += part;
  return sum;
}

}  // namespace sklar
