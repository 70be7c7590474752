#pragma once
/// Runs tests in every instruction set of this machine for which vector kernels are compiled.

#include <gtest/gtest.h>

#include <cstdint>

#include "copula/instruction_sets.hpp"
//
#include <hwy/targets.h>

namespace sklar::test {

/// Calls body() with each set in turn as the one chosen at run time, named in the trace of failures.
template <class Body>
void for_each_target(const Body& body) {
  const std::int64_t all = hwy::SupportedTargets() & HWY_TARGETS;
  for (std::int64_t target = 1; target > 0 && target <= HWY_STATIC_TARGET; target <<= 1) {
    if ((all & target) == 0) continue;
    SCOPED_TRACE(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    body();
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace sklar::test
