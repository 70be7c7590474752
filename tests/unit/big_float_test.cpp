#include "copula/big_float.hpp"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "tests/support/digits.hpp"

namespace sklar {
namespace {

/// pi, from https://oeis.org/A000796.
const std::string kPi =
    "3.14159265358979323846264338327950288419716939937510582097494459230781640628620899862803482534";

TEST(BigFloat, HasTheDigitsInForce) {
  for (const int digits : {20, 70, 90}) {
    const WorkingPrecision precision(digits);
    const BigFloat error = abs(4 * atan(BigFloat(1)) - BigFloat(kPi));
    EXPECT_LT(error, pow(BigFloat(10), 1 - digits)) << digits;
  }
}

TEST(BigFloat, PrecisionNestsAndBelongsToTheThread) {
  const long before = WorkingPrecision::bits();
  const WorkingPrecision outer(100);
  const long at_100 = WorkingPrecision::bits();
  EXPECT_GE(at_100, 333);
  {
    const WorkingPrecision inner(1000);
    EXPECT_GE(WorkingPrecision::bits(), 3322);
    long elsewhere = 0;
    std::thread([&] { elsewhere = WorkingPrecision::bits(); }).join();
    EXPECT_EQ(elsewhere, before);
  }
  EXPECT_EQ(WorkingPrecision::bits(), at_100);
  EXPECT_THROW(WorkingPrecision(1), std::invalid_argument);
}

TEST(BigFloat, CopiesAndMovesKeepTheirDigits) {
  for (const int digits : {30, 200}) {  // within the object, on the heap
    std::vector<BigFloat> values;
    {
      const WorkingPrecision precision(digits);
      for (int i = 1; i < 20; ++i) values.push_back(BigFloat(1) / i);  // moves as it grows
    }
    BigFloat copy = values[2];
    const BigFloat& itself = copy;
    copy = itself;
    BigFloat moved = std::move(values[2]);
    values[2] = moved;
    std::swap(values[0], values[1]);
    EXPECT_EQ(copy, moved);
    EXPECT_EQ(values[2], copy);
    EXPECT_EQ(values[0], BigFloat(0.5));
    const WorkingPrecision precision(digits);
    EXPECT_EQ(copy, BigFloat(1) / 3);
  }
}

TEST(BigFloat, ExponentsHave62Bits) {
  const WorkingPrecision precision(20);
  EXPECT_TRUE(isfinite(exp(BigFloat(3e18))));
  EXPECT_GT(exp(BigFloat(-3e18)), 0);
  EXPECT_TRUE(isinf(exp(BigFloat(4e18))));
}

TEST(BigFloat, TextAndNumbers) {
  const WorkingPrecision precision(40);
  EXPECT_EQ(to_text(BigFloat("0.1"), 30), "1.00000000000000000000000000000e-01");
  EXPECT_EQ(to_text(BigFloat("-2.5e3"), 3), "-2.50e+03");
  EXPECT_EQ(to_text(log(BigFloat(0)), 5), "-inf");
  EXPECT_EQ(to_text(log(BigFloat(-1)), 5), "nan");
  EXPECT_THROW(BigFloat("1,5"), std::invalid_argument);
  EXPECT_EQ(static_cast<double>(BigFloat(0.1L)), 0.1);
  EXPECT_EQ(static_cast<double>(BigFloat("3e-324")), 4.9406564584124654e-324);
  EXPECT_FALSE(BigFloat(std::numeric_limits<double>::quiet_NaN()) == 0);
}

}  // namespace
}  // namespace sklar
