/// What every copula is and does, whatever the family: shapes, errors, NaN rows, a distribution function with uniform
/// margins.

#include <array>
#include <functional>

#include "tests/conformance/family_test.hpp"

namespace sklar::test {
namespace {

SKLAR_FAMILY_SUITE(Contract);

constexpr double kRounding = 4e-13;  // a few cdf values of relative error 9.5e-14

using Quantity = std::pair<const char*, std::function<Points(const Copula&, const Points&)>>;

/// Every call that maps rows to rows.
const std::vector<Quantity>& quantities() {
  static const std::vector<Quantity> list = {
      {"log_pdf", [](const Copula& c, const Points& u) { return c.log_pdf(u); }},
      {"pdf", [](const Copula& c, const Points& u) { return c.pdf(u); }},
      {"log_cdf", [](const Copula& c, const Points& u) { return c.log_cdf(u); }},
      {"cdf", [](const Copula& c, const Points& u) { return c.cdf(u); }},
      {"h", [](const Copula& c, const Points& u) { return c.h(u); }},
      {"h_upper", [](const Copula& c, const Points& u) { return c.h_upper(u); }},
      {"h_inv", [](const Copula& c, const Points& u) { return c.h_inv(u); }},
      {"h_inv_upper", [](const Copula& c, const Points& u) { return c.h_inv_upper(u); }},
      {"rosenblatt", [](const Copula& c, const Points& u) { return c.rosenblatt(u); }},
      {"inverse_rosenblatt", [](const Copula& c, const Points& u) { return c.inverse_rosenblatt(u); }},
  };
  return list;
}

bool identical(const Points& a, const Points& b) {
  return (a == b || (a.isNaN() && b.isNaN())).all();
}

template <class Exception>
std::string message_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const Exception& error) {
    return error.what();
  }
  ADD_FAILURE() << "no exception";
  return {};
}

TEST_P(Contract, ExamplesSpanEveryDimension) {
  for (const int dim : {2, 3, 5, 10, 50, 100}) EXPECT_FALSE(cases({dim}).empty()) << dim;
  if (family().parameters.empty()) return;
  double weakest = 1, strongest = 0;
  for (const FamilyCase& next : cases({2})) {
    weakest = std::min(weakest, std::abs(next.tau()));
    strongest = std::max(strongest, std::abs(next.tau()));
  }
  EXPECT_LT(weakest, 0.01);
  if (family().parameters.size() == 1) {
    EXPECT_GT(strongest, 0.8 * std::max(std::abs(family().tau_range(2).lowest), family().tau_range(2).highest));
  }
}

TEST_P(Contract, ABatchIsItsRowsToTheBit) {
  Rng rng(seed_of_this_test());
  for (const FamilyCase& next : cases({2, 3, 10, 50})) {
    SCOPED_TRACE(next.name());
    const CopulaPtr copula = next.copula();
    // ordinary rows first, extreme and NaN rows appended
    Points u(12, next.dim);
    u << uniforms(rng, 4, next.dim), hard_points(8, next.dim, rng);
    u.row(9).setConstant(5e-324);
    u.row(10).setConstant(1 - 0x1p-53);
    u(11, static_cast<Index>(rng() % static_cast<unsigned>(next.dim))) = std::nan("");
    for (const auto& [name, compute] : quantities()) {
      const Points batch = compute(*copula, u);
      ASSERT_EQ(batch.rows(), u.rows());
      for (Index i = 0; i < u.rows(); ++i) {
        EXPECT_TRUE(identical(batch.row(i), compute(*copula, u.row(i)))) << name << row_text(u, i);
        EXPECT_EQ(batch.row(i).hasNaN(), i == 11) << name << row_text(u, i);
      }
      EXPECT_EQ(compute(*copula, Points(0, next.dim)).rows(), 0);
    }
  }
}

TEST_P(Contract, BadShapesAndValuesAreNamed) {
  for (const int dim : {2, 5}) {
    const CopulaPtr copula = cases({dim}).front().copula();
    EXPECT_EQ(copula->dim(), dim);
    Points u = Points::Constant(3, dim, 0.5);
    u(1, dim - 1) = 1.25;
    for (const auto& [name, quantity] : quantities()) {
      SCOPED_TRACE(name);
      const auto& compute = quantity;  // Clang 14 cannot capture a structured binding
      const std::string narrow =
          message_of<std::invalid_argument>([&] { (void)compute(*copula, Points::Constant(3, dim + 1, 0.5)); });
      EXPECT_NE(narrow.find("got " + std::to_string(dim + 1)), std::string::npos) << narrow;
      const std::string outside = message_of<std::domain_error>([&] { (void)compute(*copula, u); });
      EXPECT_NE(outside.find("(1," + std::to_string(dim - 1) + ") = 1.25"), std::string::npos) << outside;
    }
    EXPECT_THROW((void)copula->inverse_rosenblatt(Points::Constant(2, 1, 0.5), Points::Constant(3, dim - 1, 0.5)),
                 std::invalid_argument);
    EXPECT_THROW((void)copula->inverse_rosenblatt(Points(2, 0), Points::Constant(2, dim, 0.5)), std::invalid_argument);
    Rng rng(1);
    EXPECT_THROW((void)copula->sample(0, rng), std::invalid_argument);
  }
  EXPECT_THROW((void)family().make(1, family().examples.front()), std::invalid_argument);
  Theta too_many = family().examples.front();
  too_many.push_back(1);
  EXPECT_THROW((void)family().make(2, too_many), std::invalid_argument);
}

TEST_P(Contract, AValueOutsideIsNamedByItsRowInALargeBatch) {
  const CopulaPtr copula = cases({2}).front().copula();
  Points u = Points::Constant(9000, 2, 0.5);
  u(8500, 1) = -0.25;
  for (const Accuracy accuracy : {Accuracy::fast, Accuracy::standard}) {
    const std::string joint = message_of<std::domain_error>([&] { (void)copula->log_pdf(u, accuracy); });
    EXPECT_NE(joint.find("log_pdf: u must be in [0,1], got u(8500,1) = -0.25"), std::string::npos) << joint;
    const std::string inverse = message_of<std::domain_error>([&] { (void)copula->h_inv(u, accuracy); });
    EXPECT_NE(inverse.find("h_inv: u must be in [0,1], got u(8500,1) = -0.25"), std::string::npos) << inverse;
  }
}

TEST_P(Contract, ParametersOutsideTheDomainAreNamed) {
  for (std::size_t i = 0; i < family().parameters.size(); ++i) {
    for (const int dim : {2, 3, 5, 10}) {
      const Interval domain = family().parameters[i].domain(dim);
      const double inf = std::numeric_limits<double>::infinity();
      for (const double outside :
           {domain.lowest_included ? std::nextafter(domain.lowest, -inf) : domain.lowest,
            domain.highest_included ? std::nextafter(domain.highest, inf) : domain.highest, std::nan("")}) {
        Theta theta = cases({dim}).front().theta;
        theta[i] = outside;
        const std::string message = message_of<std::domain_error>([&] { (void)family().make(dim, theta); });
        for (const std::string& part : {family().name, family().parameters[i].name, to_text(outside),
                                        "dimension " + std::to_string(dim), domain.to_text()}) {
          EXPECT_NE(message.find(part), std::string::npos) << message << " lacks " << part;
        }
      }
    }
  }
}

TEST_P(Contract, MarginsAreUniform) {
  constexpr double kTolerance = 1e-13;  // of log u
  for (const FamilyCase& next : cases({2, 3, 10, 100})) {
    SCOPED_TRACE(next.name());
    const CopulaPtr copula = next.copula();
    for (const double value : hard_values()) {
      for (const int k : {0, next.dim - 1}) {
        Points u = Points::Ones(1, next.dim);
        u(0, k) = value;
        const double log_u = std::log(value);
        EXPECT_NEAR(copula->log_cdf(u)(0), log_u, kTolerance * std::max(1.0, -log_u)) << value;
      }
    }
  }
}

TEST_P(Contract, CdfKeepsTheFrechetBoundsAndIncreases) {
  Rng rng(seed_of_this_test());
  for (const FamilyCase& next : cases({2, 3, 5, 10, 50})) {
    SCOPED_TRACE(next.name());
    const CopulaPtr copula = next.copula();
    const Points u = hard_points(60, next.dim, rng);
    const Column log_cdf = copula->log_cdf(u), cdf = copula->cdf(u);
    for (Index i = 0; i < u.rows(); ++i) {
      const double log_upper = std::log(u.row(i).minCoeff());
      EXPECT_LE(log_cdf(i), log_upper + kRounding * std::max(1.0, -log_upper)) << row_text(u, i);
      EXPECT_GE(cdf(i), 1 - (1 - u.row(i)).sum() - kRounding) << row_text(u, i);
    }
    for (int k = 0; k < next.dim; k += std::max(1, next.dim / 3)) {
      Points higher = u;
      higher.col(k) = (u.col(k) * 1.5).min(0.5 * (1 + u.col(k)));
      const Column raised = copula->log_cdf(higher);
      for (Index i = 0; i < u.rows(); ++i) {
        EXPECT_TRUE(raised(i) >= log_cdf(i) - kRounding * std::max(1.0, std::abs(log_cdf(i)))) << row_text(u, i);
      }
    }
  }
}

TEST_P(Contract, BoxesHaveNonNegativeVolume) {
  Rng rng(seed_of_this_test());
  for (const FamilyCase& next : cases({2, 3, 5})) {
    SCOPED_TRACE(next.name());
    const CopulaPtr copula = next.copula();
    const Points a = hard_points(40, next.dim, rng), b = hard_points(40, next.dim, rng);
    const Points lowest = a.min(b), highest = a.max(b);
    Column volume = Column::Zero(a.rows());
    for (unsigned corner = 0; corner < 1U << next.dim; ++corner) {
      Points u(a.rows(), next.dim);
      int lower = 0;
      for (int k = 0; k < next.dim; ++k) {
        const bool low = (corner >> k & 1U) != 0;
        lower += low ? 1 : 0;
        u.col(k) = low ? lowest.col(k) : highest.col(k);
      }
      volume += (lower % 2 == 0 ? 1.0 : -1.0) * copula->cdf(u);
    }
    const double noise = kRounding * std::exp2(next.dim);
    EXPECT_GE(volume.minCoeff(), -noise);
    EXPECT_LE(volume.maxCoeff(), 1 + noise);
  }
}

}  // namespace
}  // namespace sklar::test
