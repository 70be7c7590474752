#include "families/registry.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace sklar {
namespace {

TEST(Registry, NamesAreUniqueAndFound) {
  std::set<std::string> names;
  for (const FamilyInfo& family : families::all()) {
    EXPECT_TRUE(names.insert(family.name).second) << family.name;
    EXPECT_EQ(&families::find(family.name), &family);
  }
  EXPECT_FALSE(names.empty());
}

TEST(Registry, UnknownNameListsTheKnownOnes) {
  try {
    (void)families::find("gaussian");
    FAIL() << "no exception";
  } catch (const std::invalid_argument& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("'gaussian'"), std::string::npos) << message;
    for (const FamilyInfo& family : families::all()) EXPECT_NE(message.find(family.name), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace sklar
