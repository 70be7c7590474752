#include "families/registry.hpp"

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "copula/error.hpp"

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

TEST(Registry, RotationsAreFoundByName) {
  const FamilyInfo& survival = families::find("clayton@180");
  EXPECT_EQ(survival.name, "clayton@180");
  EXPECT_EQ(&families::find("clayton@180"), &survival);
  EXPECT_EQ(&families::resolve("clayton@180"), &survival);
  EXPECT_EQ(families::find("gumbel@u3+u1").name, "gumbel@u1+u3");
  for (const std::string name : {"clayton@", "clayton@45", "@90", "x@90", "clayton@90@90", "x.json@90"}) {
    EXPECT_THROW((void)families::find(name), std::invalid_argument) << name;
  }
  EXPECT_THROW((void)families::resolve("missing.json@90"), FileError);
}

TEST(Registry, ThreadsThatAskAtOnceGetOneFamily) {
  std::array<const FamilyInfo*, 4> found{};
  std::vector<std::thread> threads;
  threads.reserve(found.size());
  for (const FamilyInfo*& family : found) threads.emplace_back([&family] { family = &families::find("joe@90"); });
  for (std::thread& thread : threads) thread.join();
  for (const FamilyInfo* family : found) EXPECT_EQ(family, &families::find("joe@90"));
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
