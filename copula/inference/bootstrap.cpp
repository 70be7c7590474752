#include "copula/inference/bootstrap.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <mutex>
#include <stdexcept>
#include <string>

namespace sklar {
namespace {

/// The last step of SplitMix64, a bijection of 64 bits: neighbouring numbers become unrelated seeds. Steele, Lea and
/// Flood (2014), OOPSLA, 453.
std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9;
  x = (x ^ x >> 27) * 0x94d049bb133111eb;
  return x ^ x >> 31;
}

}  // namespace

void for_each_replicate(const Copula& copula, Index n, const BootstrapOptions& options,
                        const std::function<void(int replicate, const Points& u)>& body) {
  if (options.replicates < 1) {
    throw std::invalid_argument("bootstrap: replicates must be 1 or more, got " + std::to_string(options.replicates));
  }
  std::mutex mutex;
  int done = 0;
  oneapi::tbb::parallel_for(0, options.replicates, [&](int replicate) {
    Rng rng(mixed(mixed(options.seed) + static_cast<std::uint64_t>(replicate)));
    body(replicate, copula.sample(n, rng));
    if (!options.progress) return;
    const std::lock_guard lock(mutex);
    options.progress(static_cast<double>(++done) / options.replicates);
  });
}

}  // namespace sklar
