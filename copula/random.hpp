#pragma once
/// Seeded uniforms, the same on every platform.

#include <array>
#include <bit>
#include <cstdint>
#include <limits>

#include "copula/types.hpp"

namespace sklar {

/// The 64-bit Mersenne Twister: the numbers of std::mt19937_64 from the same seed, made by vectors. Matsumoto and
/// Nishimura (1998), ACM TOMACS 8, 3; Nishimura (2000), ACM TOMACS 10, 348. A uniform random bit generator.
class Rng {
 public:
  using result_type = std::uint64_t;

  explicit Rng(result_type seed = 5489);

  static constexpr result_type min() { return 0; }
  static constexpr result_type max() { return std::numeric_limits<result_type>::max(); }

  result_type operator()() {
    if (next_ == kSize) refill();
    return numbers_[next_++];
  }

 private:
  static constexpr std::size_t kSize = 312;

  void refill();

  std::array<result_type, kSize + 1> state_;  // the last word is for the making of the next ones
  std::array<result_type, kSize> numbers_;
  std::size_t next_ = kSize;
};

/// One uniform strictly inside (0,1): the midpoints of 2^52 equal cells, so that 0 and 1 never occur.
[[nodiscard]] inline double uniform(Rng& rng) {
  constexpr std::uint64_t kOne = 0x3ff0000000000000;  // the bits of 1.0
  return std::bit_cast<double>(rng() >> 12 | kOne) - (1 - 0x1p-53);
}

/// Uniforms for every entry, row by row, so that the first rows do not depend on how many follow.
void fill_uniforms(Rng& rng, PointsOut w);

/// rows x columns uniforms in that order.
[[nodiscard]] Points uniforms(Rng& rng, Index rows, Index columns);

}  // namespace sklar
