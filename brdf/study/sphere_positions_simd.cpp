#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "brdf/study/sphere_positions_simd.cpp"
#include "copula/instruction_sets.hpp"
//
#include <hwy/foreach_target.h>
//
#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

#include <numbers>

#include "brdf/data/measured_table.hpp"
#include "brdf/study/sphere_positions.hpp"

HWY_BEFORE_NAMESPACE();
namespace sklar::brdf::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

void positions(const double* x, const double* y, const double* z, std::size_t count, double* theta_h, double* phi_d) {
  constexpr double kPi = std::numbers::pi;
  const hn::ScalableTag<double> d;
  const auto half = hn::Set(d, 0.5), zero = hn::Zero(d);
  const auto polar_scale = hn::Set(d, Grid::theta_h * Grid::theta_h / (kPi / 2));
  const auto azimuth_scale = hn::Set(d, Grid::phi_d / kPi), half_turn = hn::Set(d, Grid::phi_d);
  for (std::size_t n = 0; n < count; n += hn::Lanes(d)) {
    const auto vx = hn::LoadU(d, x + n), vy = hn::LoadU(d, y + n);
    const auto radius = hn::Sqrt(hn::MulAdd(vx, vx, hn::Mul(vy, vy)));
    const auto polar = hn::Atan(d, hn::Div(radius, hn::LoadU(d, z + n)));
    hn::StoreU(hn::Sub(hn::Sqrt(hn::Mul(polar_scale, polar)), half), d, theta_h + n);
    // Exchanging the directions turns by pi: the azimuth of (x, y) or (-x, -y), whichever lies in [0,pi).
    const auto azimuth = hn::Mul(azimuth_scale, hn::Atan(d, hn::Div(vy, vx)));
    const auto turned = hn::IfThenElse(hn::Lt(azimuth, zero), hn::Add(azimuth, half_turn), azimuth);
    hn::StoreU(hn::Sub(hn::IfThenElse(hn::Eq(radius, zero), zero, turned), half), d, phi_d + n);
  }
}

}  // namespace sklar::brdf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sklar::brdf {
namespace {
HWY_EXPORT(positions);
}  // namespace

void sphere_positions(const double* x, const double* y, const double* z, std::size_t count, double* theta_h,
                      double* phi_d) {
  HWY_DYNAMIC_DISPATCH(positions)(x, y, z, count, theta_h, phi_d);
}

}  // namespace sklar::brdf
#endif
