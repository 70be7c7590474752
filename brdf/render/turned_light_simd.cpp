#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "brdf/render/turned_light_simd.cpp"
#include "copula/instruction_sets.hpp"
//
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

#include "brdf/render/turned_light.hpp"

HWY_BEFORE_NAMESPACE();
namespace sklar::brdf::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

void add(const float* upper, const float* lower, const std::array<double, 4>& share, std::size_t count, float* ring) {
  const hn::ScalableTag<float> d;
  const auto w = [&](std::size_t n) { return hn::Set(d, static_cast<float>(share[n])); };
  const auto w0 = w(0), w1 = w(1), w2 = w(2), w3 = w(3);
  for (std::size_t a = 0; a < count; a += hn::Lanes(d)) {
    const auto above = hn::Add(hn::Mul(w0, hn::LoadU(d, upper + a)), hn::Mul(w1, hn::LoadU(d, upper + a + 1)));
    const auto sum =
        hn::Add(hn::Add(above, hn::Mul(w2, hn::LoadU(d, lower + a))), hn::Mul(w3, hn::LoadU(d, lower + a + 1)));
    hn::StoreU(hn::Add(hn::LoadU(d, ring + a), sum), d, ring + a);
  }
}

}  // namespace sklar::brdf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sklar::brdf {
namespace {
HWY_EXPORT(add);
}  // namespace

void add_turned_light(const float* upper, const float* lower, const std::array<double, 4>& share, std::size_t count,
                      float* ring) {
  HWY_DYNAMIC_DISPATCH(add)(upper, lower, share, count, ring);
}

}  // namespace sklar::brdf
#endif
