/// The error of a model at cells side by side and its derivative; included once for each instruction set.

#if defined(SKLAR_BRDF_MODEL_CELL_ERROR_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKLAR_BRDF_MODEL_CELL_ERROR_INL_H_
#undef SKLAR_BRDF_MODEL_CELL_ERROR_INL_H_
#else
#define SKLAR_BRDF_MODEL_CELL_ERROR_INL_H_
#endif

#include <hwy/highway.h>

#include "brdf/model/refined_loss.hpp"
#include "copula/simd/math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sklar::brdf::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace sn = sklar::simd::HWY_NAMESPACE;
using D = hn::CappedTag<float, kLossColumns>;
using V = hn::Vec<D>;

constexpr float kFloor = 1e-3F, kTiny = 1e-12F;
constexpr float kRelativeSoftness = 4;  // times that of log1p

struct Term {
  V value, slope;
};

/// sqrt(x^2 + e^2) - e.
HWY_INLINE Term soft_absolute(V x, V e) {
  const V root = hn::Sqrt(hn::MulAdd(x, x, hn::Mul(e, e)));
  return {hn::Sub(root, e), hn::Div(x, root)};
}

/// |ln((g c + floor) / (f c + floor))| and its derivative by g.
HWY_INLINE Term log_ratio(V f, V g, V c, float floor, float softness) {
  const D d;
  const V to = hn::Set(d, floor), inverse = hn::Div(hn::Set(d, 1.0F), hn::MulAdd(g, c, to));
  const V log_ratio = hn::Neg(sn::log(d, hn::Mul(hn::MulAdd(f, c, to), inverse)));
  const Term soft = soft_absolute(log_ratio, hn::Set(d, softness));
  return {soft.value, hn::Mul(soft.slope, hn::Mul(c, inverse))};
}

HWY_INLINE V cube_root(V x) {
  const D d;
  return sn::exp(d, hn::Mul(hn::Set(d, 1.0F / 3), sn::log(d, hn::Add(x, hn::Set(d, kTiny)))));
}

HWY_INLINE Term cube_root_error(V f, V g, V c) {
  const D d;
  const V root = cube_root(hn::Mul(g, c)), miss = hn::Sub(root, cube_root(hn::Mul(f, c)));
  const V slope = hn::Div(hn::Mul(hn::Set(d, 2.0F / 3), hn::Mul(miss, c)), hn::Mul(root, root));
  return {hn::Mul(miss, miss), slope};
}

HWY_INLINE Term square_error(V f, V g, V c) {
  const V miss = hn::Mul(hn::Sub(g, f), c);
  return {hn::Mul(miss, miss), hn::Mul(hn::Set(D(), 2.0F), hn::Mul(miss, c))};
}

HWY_INLINE Term poisson_error(V f, V g, V w) {
  const D d;
  const V tiny = hn::Set(d, kTiny), ratio = hn::Div(hn::Add(f, tiny), hn::Add(g, tiny));
  const V value = hn::MulAdd(f, sn::log(d, ratio), hn::Sub(g, f));
  return {hn::Mul(w, value), hn::Mul(w, hn::Sub(hn::Set(d, 1.0F), hn::Div(f, hn::Add(g, tiny))))};
}

/// Sum of the weighted measures at some cells of one channel.
struct Total {
  V value, slope;

  HWY_INLINE void add(float weight, const Term& term) {
    const V w = hn::Set(D(), weight);
    value = hn::MulAdd(w, term.value, value);
    slope = hn::MulAdd(w, term.slope, slope);
  }
};

HWY_INLINE Total cell_error(const LossWeights& w, V f, V g, V cos_i, V cos_o) {
  const D d;
  Total total{hn::Zero(d), hn::Zero(d)};
  const V both = hn::Max(hn::Mul(cos_i, cos_o), hn::Set(d, kFloor));
  if (w.log1p > 0) {
    total.add(w.log1p / 2, log_ratio(f, g, cos_i, 1, w.softness));
    total.add(w.log1p / 2, log_ratio(f, g, cos_o, 1, w.softness));
  }
  if (w.log_relative > 0) total.add(w.log_relative, log_ratio(f, g, both, kFloor, kRelativeSoftness * w.softness));
  if (w.cube_root > 0) {
    total.add(w.cube_root / 2, cube_root_error(f, g, cos_i));
    total.add(w.cube_root / 2, cube_root_error(f, g, cos_o));
  }
  if (w.likelihood > 0) total.add(w.likelihood, poisson_error(f, g, both));
  if (w.image > 0) {
    total.add(w.image / 2, square_error(f, g, cos_i));
    total.add(w.image / 2, square_error(f, g, cos_o));
  }
  return total;
}

HWY_INLINE float sum(V x) {
  return hn::GetLane(hn::SumOfLanes(D(), x));
}

}  // namespace sklar::brdf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
