#pragma once
/// The parametric bootstrap: samples of a fitted copula.

#include <cstdint>
#include <functional>

#include "copula/copula.hpp"

namespace sklar {

/// How a parametric bootstrap draws and fits.
struct BootstrapOptions {
  int replicates = 1000;   ///< >= 1
  std::uint64_t seed = 1;  ///< one seed gives one result, whatever the number of threads

  /// Given the share done, in (0,1], rising, never by two threads at once. What it throws ends the work.
  std::function<void(double share)> progress{};
};

/// Calls body(replicate, u) for replicate = 0, 1, .. once each, on all threads and in any order; u is n x d, drawn with
/// a random stream that depends on seed and replicate alone.
/// @throws std::invalid_argument for n or replicates below 1, and what body throws.
void for_each_replicate(const Copula& copula, Index n, const BootstrapOptions& options,
                        const std::function<void(int replicate, const Points& u)>& body);

}  // namespace sklar
