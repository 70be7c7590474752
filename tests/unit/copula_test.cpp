#include "copula/copula.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace sklar {
namespace {

/// Gives its first coordinate's logarithm as the logarithm of everything, +inf for u_1 = 1.
class LogOfFirst final : public Copula {
 public:
  LogOfFirst() : Copula(2) {}

 private:
  static void first(const PointsRef& u, ColumnOut out) {
    out = u.col(0).unaryExpr([](double v) { return v == 1 ? std::numeric_limits<double>::infinity() : std::log(v); });
  }
  void log_pdf_into(const PointsRef& u, const Reflection&, ColumnOut out) const override { first(u, out); }
  void log_cdf_into(const PointsRef& u, const Reflection&, ColumnOut out) const override { first(u, out); }
  void conditional_into(const PointsRef& u, const Reflection&, Tail, ColumnOut out) const override { first(u, out); }
  void conditional_inverse_into(const PointsRef& u, const Reflection&, Tail, ColumnOut out) const override {
    first(u, out);
  }
  bool has_frailty() const override { return false; }
  BigFloat exact_row(Quantity, std::span<const BigFloat> u, const Reflection&, int) const override {
    return log(u.front());
  }
  void draw(Route, const Reflection&, Rng& rng, std::span<double> u) const override {
    for (double& value : u) value = uniform(rng);
  }
};

TEST(Copula, ValuesReachZeroInfinityAndSubnormals) {
  const double subnormal = std::exp(std::log(1e-310));
  Points u(5, 2);
  u << 0, 0.5, 1, 0.5, 1e-310, 0.5, std::nan(""), 0.5, 0.25, 0.5;
  for (const Column& value : {LogOfFirst().pdf(u), LogOfFirst().cdf(u)}) {
    EXPECT_EQ(value[0], 0);
    EXPECT_EQ(value[1], std::numeric_limits<double>::infinity());
    EXPECT_EQ(value[2], subnormal);
    EXPECT_TRUE(std::isnan(value[3]));
    EXPECT_EQ(value[4], 0.25);
  }
}

}  // namespace
}  // namespace sklar
