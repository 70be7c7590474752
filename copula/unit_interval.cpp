#include "copula/unit_interval.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "copula/unit_interval.cpp"
#include "copula/instruction_sets.hpp"
//
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace sklar::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

bool none_outside(const double* numbers, Index count) {
  const hn::ScalableTag<double> d;
  const auto lanes = static_cast<Index>(hn::Lanes(d));
  const auto zero = hn::Zero(d), one = hn::Set(d, 1.0);
  auto outside = hn::Lt(zero, zero);
  Index i = 0;
  for (; i + lanes <= count; i += lanes) {
    const auto x = hn::LoadU(d, numbers + i);
    outside = hn::Or(outside, hn::Or(hn::Lt(x, zero), hn::Gt(x, one)));
  }
  bool good = hn::AllFalse(d, outside);
  for (; i < count; ++i) good = good && !(numbers[i] < 0 || numbers[i] > 1);
  return good;
}

}  // namespace sklar::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sklar {

HWY_EXPORT(none_outside);

bool none_outside_unit_interval(const double* numbers, Index count) {
  return HWY_DYNAMIC_DISPATCH(none_outside)(numbers, count);
}

}  // namespace sklar
#endif
