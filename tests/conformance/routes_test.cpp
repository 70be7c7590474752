/// Each closed form equals the generic route, in the middle and at both ends.

#include "tests/conformance/family_test.hpp"
#include "tests/conformance/generic_copula.hpp"

namespace sklar::test {
namespace {

SKLAR_FAMILY_SUITE(Routes);

/// Compares values of the two routes; the generic one gives NaN where 70 digits do not resolve it.
class Comparison {
 public:
  /// Both within `tolerance` of the truth, relative to the value or to `floor` if that is larger.
  void expect_same(const Column& fused, const Column& generic, double tolerance, double floor, const char* quantity,
                   const Points& u) {
    for (Index i = 0; i < u.rows(); ++i) {
      ++count_;
      if (std::isnan(generic(i))) continue;
      ++resolved_;
      const double bound = 2 * tolerance * std::max(floor, std::abs(fused(i)));
      EXPECT_TRUE(fused(i) == generic(i) || std::abs(fused(i) - generic(i)) <= bound)
          << quantity << row_text(u, i) << ": " << to_text(fused(i)) << ", generic " << to_text(generic(i));
    }
  }

  [[nodiscard]] double share_resolved() const { return static_cast<double>(resolved_) / count_; }

 private:
  int count_ = 0, resolved_ = 0;
};

TEST_P(Routes, ClosedFormsEqualTheGenericRoute) {
  constexpr double kResolved = 0.8;  // the rest are h_upper and h_inv of extreme dependence
  Rng rng(seed_of_this_test());
  Comparison compare;
  for (const FamilyCase& next : cases({2, 3, 5, 10})) {
    if (next.tau() == 0 && !family().parameters.empty()) continue;  // another family's class
    SCOPED_TRACE(next.name());
    const CopulaPtr fused = next.copula(), generic = generic_copula(family().name, next.dim, next.theta);
    const Points u = hard_points(40, next.dim, rng);
    compare.expect_same(fused->log_cdf(u), generic->log_cdf(u), kLogTolerance, 1, "log_cdf", u);
    compare.expect_same(fused->log_pdf(u), generic->log_pdf(u), kLogTolerance, 1, "log_pdf", u);
    compare.expect_same(fused->h(u), generic->h(u), kHTolerance, 0, "h", u);
    compare.expect_same(fused->h_upper(u), generic->h_upper(u), kHTolerance, 0, "h_upper", u);
    compare.expect_same(fused->h_inv(u), generic->h_inv(u), kInverseTolerance, 0, "h_inv", u);
    compare.expect_same(fused->h_inv_upper(u), generic->h_inv_upper(u), kInverseTolerance, 0, "h_inv_upper", u);
  }
  EXPECT_GT(compare.share_resolved(), kResolved);
}

}  // namespace
}  // namespace sklar::test
