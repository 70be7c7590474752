/// The density integrates to the probability of a box, which comes from the textbook psi.

#include <boost/math/quadrature/gauss.hpp>

#include "tests/conformance/family_test.hpp"
#include "tests/support/psi_reference.hpp"

namespace sklar::test {
namespace {

SKLAR_FAMILY_SUITE(Integral);

struct Box {
  std::vector<double> lower, upper;
};

Box box_about(const Column& centre, double share) {
  Box box;
  for (const double value : centre) {
    const double half = share * std::min(value, 1 - value);
    box.lower.push_back(value - half);
    box.upper.push_back(value + half);
  }
  return box;
}

Points corners(const Box& box) {
  const auto dim = static_cast<Index>(box.lower.size());
  Points u(Index{1} << dim, dim);
  for (Index i = 0; i < u.rows(); ++i) {
    for (Index k = 0; k < dim; ++k) {
      const auto side = static_cast<std::size_t>(k);
      u(i, k) = (i >> k & 1) != 0 ? box.lower[side] : box.upper[side];
    }
  }
  return u;
}

/// A box about the conditional medians from u_1 = `first` on, so small that the density changes little in it: every
/// conditional probability of its corners is between 0.35 and 0.65.
Box box_about_medians(const Copula& copula, double first) {
  Points u = Points::Constant(1, copula.dim(), 0.5);
  u(0, 0) = first;
  for (Index k = 1; k < u.cols(); ++k) u(0, k) = copula.h_inv(u.leftCols(k + 1))(0);
  for (double share = 0.4; share > 1e-6; share /= 2) {
    const Points at = corners(box_about(u.row(0), share));
    bool small = true;
    for (Index k = 1; k < u.cols(); ++k) small = small && ((copula.h(at.leftCols(k + 1)) - 0.5).abs() < 0.15).all();
    if (small) return box_about(u.row(0), share);
  }
  throw std::runtime_error("no box with a nearly constant density about " + to_text(first));
}

using Gauss = boost::math::quadrature::gauss<double, 15>;

/// The nodes of a rule on [-1, 1] and their weights, both signs.
std::vector<std::pair<double, double>> nodes() {
  std::vector<std::pair<double, double>> all;
  for (std::size_t i = 0; i < Gauss::abscissa().size(); ++i) {
    all.emplace_back(Gauss::abscissa()[i], Gauss::weights()[i]);
    if (Gauss::abscissa()[i] > 0) all.emplace_back(-Gauss::abscissa()[i], Gauss::weights()[i]);
  }
  return all;
}

double integral_of_pdf(const Copula& copula, const Box& box) {
  const auto rule = nodes();
  const auto dim = static_cast<std::size_t>(copula.dim());
  Index count = 1;
  for (std::size_t k = 0; k < dim; ++k) count *= static_cast<Index>(rule.size());
  Points u(count, copula.dim());
  Column weight = Column::Ones(count);
  for (Index i = 0; i < count; ++i) {
    auto rest = static_cast<std::size_t>(i);
    for (std::size_t k = 0; k < dim; ++k) {
      const auto [node, share] = rule[rest % rule.size()];
      rest /= rule.size();
      const double half = 0.5 * (box.upper[k] - box.lower[k]);
      u(i, static_cast<Index>(k)) = 0.5 * (box.lower[k] + box.upper[k]) + half * node;
      weight(i) *= half * share;
    }
  }
  return (copula.pdf(u) * weight).sum();
}

TEST_P(Integral, OfTheDensityIsTheProbabilityOfABox) {
  for (const FamilyCase& next : cases({2, 3})) {
    const CopulaPtr copula = next.copula();
    const PsiReference reference(family(), next.theta);
    for (const double centre : {1e-12, 1e-3, 0.5, 1 - 1e-3, 1 - 1e-9}) {
      SCOPED_TRACE(next.name() + " about " + to_text(centre));
      const Box box = box_about_medians(*copula, centre);
      const auto expected = static_cast<double>(reference.volume(box.lower, box.upper));
      // The corners are rounded to doubles: next to 1 that is a share of the box's width.
      double rounding = 0;
      for (std::size_t k = 0; k < box.lower.size(); ++k) {
        rounding += std::numeric_limits<double>::epsilon() * box.upper[k] / (box.upper[k] - box.lower[k]);
      }
      const double tolerance = 1e-10 + rounding;
      EXPECT_NEAR(integral_of_pdf(*copula, box), expected, tolerance * expected);
    }
  }
}

}  // namespace
}  // namespace sklar::test
