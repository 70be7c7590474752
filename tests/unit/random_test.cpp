// Uniforms: the standard's numbers whatever the instruction set, in the order of the rows.

#include "copula/random.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/instruction_sets.hpp"

namespace sklar::test {
namespace {

constexpr int kNumbers = 10'000;  // the state is 312

TEST(Random, NumbersAreThoseOfTheStandardOnEveryTarget) {
  for (const std::uint64_t seed : {std::uint64_t{0}, std::uint64_t{7}, ~std::uint64_t{0}}) {
    for_each_target([&] {
      std::mt19937_64 expected(seed);
      Rng rng(seed);
      for (int i = 0; i < kNumbers; ++i) ASSERT_EQ(rng(), expected()) << "number " << i << " of seed " << seed;
    });
  }
}

TEST(Random, UniformsAreMidpointsOfCells) {
  Rng rng(3), same(3);
  for (int i = 0; i < kNumbers; ++i) {
    ASSERT_EQ(uniform(rng), (static_cast<double>(same() >> 12) + 0.5) * 0x1p-52);
  }
}

TEST(Random, UniformsGoRowByRow) {
  for (const Index columns : {1, 2, 7, 100}) {
    Rng rng(4), same(4);
    const Points w = uniforms(rng, 201, columns);
    for (Index i = 0; i < w.rows(); ++i) {
      for (Index k = 0; k < columns; ++k) ASSERT_EQ(w(i, k), uniform(same)) << i << ", " << k;
    }
    EXPECT_EQ(rng(), same());
  }
}

TEST(Random, CopiesGoOnAlike) {
  Rng rng(5);
  rng();
  Rng copy = rng;
  for (int i = 0; i < kNumbers; ++i) ASSERT_EQ(rng(), copy());
}

}  // namespace
}  // namespace sklar::test
