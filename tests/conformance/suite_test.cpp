/// The suite visits every registered family.

#include <algorithm>

#include "tests/conformance/family_test.hpp"

namespace sklar::test {
namespace {

TEST(Completeness, EverySuiteRunsEveryFamily) {
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  int suites = 0;
  for (int s = 0; s < all.total_test_suite_count(); ++s) {
    const testing::TestSuite& suite = *all.GetTestSuite(s);
    if (std::string(suite.name()).rfind("Family/", 0) != 0) continue;
    ++suites;
    for (const FamilyInfo* family : registered_families()) {
      bool visited = false;
      for (int t = 0; t < suite.total_test_count(); ++t) {
        const std::string name = suite.GetTestInfo(t)->name();
        visited = visited || name.substr(name.rfind('/') + 1) == family->name;
      }
      EXPECT_TRUE(visited) << suite.name() << " does not run " << family->name;
    }
  }
  EXPECT_EQ(suites, 11);  // a suite file missing from the build would go unseen otherwise
}

}  // namespace
}  // namespace sklar::test
