#pragma once
/// The random numbers of a path tracer: functions of seed, pixel, sample and dimension alone, so that no order of
/// evaluation changes them.

#include <cstdint>

#include "brdf/brdf.hpp"

namespace sklar::brdf {

/// Points in the unit square for each (sample, dimension) of one pixel. Over the samples of one dimension they are an
/// Owen-scrambled (0,2)-sequence, the first two dimensions of Sobol's, shuffled; dimensions are independent of each
/// other. Source: Burley 2020, "Practical Hash-based Owen Scrambling", JCGT 9(4), listing 4; the hash is that of
/// Vegdahl 2021, "Building a Better LK Hash".
class PixelPoints {
 public:
  PixelPoints(std::uint64_t seed, std::uint64_t pixel) : seed_(mix(mix(seed) + pixel)) {}

  /// Strictly inside (0,1)^2, multiples of 2^-32 plus half of one.
  [[nodiscard]] Vec2 at(std::uint32_t sample, std::uint32_t dimension) const {
    const std::uint64_t bits = mix(seed_ + dimension);
    const std::uint64_t more = mix(bits);
    const std::uint32_t index = scramble(sample, static_cast<std::uint32_t>(bits));
    return {unit(scramble(reverse(index), static_cast<std::uint32_t>(bits >> 32))),
            unit(scramble(second(index), static_cast<std::uint32_t>(more)))};
  }

 private:
  /// Steele, Lea and Flood 2014, "Fast Splittable Pseudorandom Number Generators", variant 13.
  static std::uint64_t mix(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15U;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
    return x ^ (x >> 31);
  }

  static std::uint32_t reverse(std::uint32_t x) {
    x = ((x & 0x55555555U) << 1) | ((x >> 1) & 0x55555555U);
    x = ((x & 0x33333333U) << 2) | ((x >> 2) & 0x33333333U);
    x = ((x & 0x0f0f0f0fU) << 4) | ((x >> 4) & 0x0f0f0f0fU);
    x = ((x & 0x00ff00ffU) << 8) | ((x >> 8) & 0x00ff00ffU);
    return x << 16 | x >> 16;
  }

  /// Owen's nested uniform scramble: each bit flips by a hash of the bits above it.
  static std::uint32_t scramble(std::uint32_t x, std::uint32_t seed) {
    x = reverse(x);
    x ^= x * 0x3d20adeaU;
    x += seed;
    x *= (seed >> 16) | 1U;
    x ^= x * 0x05526c56U;
    x ^= x * 0x53a22864U;
    return reverse(x);
  }

  /// Sobol's second dimension; the first is reverse.
  static std::uint32_t second(std::uint32_t index) {
    std::uint32_t x = 0;
    for (std::uint32_t column = 1U << 31; index != 0; index >>= 1, column ^= column >> 1) {
      if ((index & 1U) != 0) x ^= column;
    }
    return x;
  }

  static double unit(std::uint32_t x) { return (x + 0.5) * 0x1p-32; }

  std::uint64_t seed_;
};

}  // namespace sklar::brdf
