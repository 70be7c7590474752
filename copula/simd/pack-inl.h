/// Packs of Highway vectors for one instruction set; included once for each (see Highway's foreach_target.h).
///
/// The formulas of a row are long chains of dependent steps, which leave a processor waiting. A pack takes every step
/// for several vectors in turn, so that their chains overlap. The functions are Highway's, on packs.

#if defined(SKLAR_COPULA_SIMD_PACK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKLAR_COPULA_SIMD_PACK_INL_H_
#undef SKLAR_COPULA_SIMD_PACK_INL_H_
#else
#define SKLAR_COPULA_SIMD_PACK_INL_H_
#endif

#include "copula/simd/math-inl.h"
#include "copula/types.hpp"

HWY_BEFORE_NAMESPACE();
namespace sklar::simd::HWY_NAMESPACE {
namespace pack {

/// kParts vectors of Real.
template <class Real, int kPartsOf>
struct Tag {
  using Scalar = Real;
  using Part = hn::ScalableTag<Real>;
  static constexpr int kParts = kPartsOf;
};

template <class D>
struct Vec {
  hn::Vec<typename D::Part> part[D::kParts];
};

/// Parts apart from each other: a compiler would else keep masks of few bits together in one integer.
template <class D>
struct Mask {
  struct alignas(16) alignas(hn::Mask<typename D::Part>) Part {
    hn::Mask<typename D::Part> mask;
  };
  Part part[D::kParts];
};

/// Numbers in a pack.
template <class D>
HWY_INLINE Index size(D) {
  return D::kParts * static_cast<Index>(hn::Lanes(typename D::Part()));
}

#define SKLAR_FOR_EACH_PART for (int i = 0; i < D::kParts; ++i)

#define SKLAR_LIFT_1(NAME)                                    \
  template <class D>                                          \
  HWY_INLINE Vec<D> NAME(const Vec<D>& a) {                   \
    Vec<D> result;                                            \
    SKLAR_FOR_EACH_PART result.part[i] = hn::NAME(a.part[i]); \
    return result;                                            \
  }
#define SKLAR_LIFT_2(NAME)                                               \
  template <class D>                                                     \
  HWY_INLINE Vec<D> NAME(const Vec<D>& a, const Vec<D>& b) {             \
    Vec<D> result;                                                       \
    SKLAR_FOR_EACH_PART result.part[i] = hn::NAME(a.part[i], b.part[i]); \
    return result;                                                       \
  }
#define SKLAR_LIFT_3(NAME)                                                          \
  template <class D>                                                                \
  HWY_INLINE Vec<D> NAME(const Vec<D>& a, const Vec<D>& b, const Vec<D>& c) {       \
    Vec<D> result;                                                                  \
    SKLAR_FOR_EACH_PART result.part[i] = hn::NAME(a.part[i], b.part[i], c.part[i]); \
    return result;                                                                  \
  }
#define SKLAR_LIFT_COMPARISON(NAME)                                           \
  template <class D>                                                          \
  HWY_INLINE Mask<D> NAME(const Vec<D>& a, const Vec<D>& b) {                 \
    Mask<D> result;                                                           \
    SKLAR_FOR_EACH_PART result.part[i].mask = hn::NAME(a.part[i], b.part[i]); \
    return result;                                                            \
  }
#define SKLAR_LIFT_FUNCTION(NAME)                                                                  \
  template <class D>                                                                               \
  HWY_INLINE Vec<D> NAME(D, const Vec<D>& x) {                                                     \
    Vec<D> result;                                                                                 \
    SKLAR_FOR_EACH_PART result.part[i] = simd::HWY_NAMESPACE::NAME(typename D::Part(), x.part[i]); \
    return result;                                                                                 \
  }
#define SKLAR_LIFT_FUNCTION_2(NAME)                                                                           \
  template <class D>                                                                                          \
  HWY_INLINE Vec<D> NAME(D, const Vec<D>& x, const Vec<D>& y) {                                               \
    Vec<D> result;                                                                                            \
    SKLAR_FOR_EACH_PART result.part[i] = simd::HWY_NAMESPACE::NAME(typename D::Part(), x.part[i], y.part[i]); \
    return result;                                                                                            \
  }

SKLAR_LIFT_1(Neg)
SKLAR_LIFT_1(Abs)
SKLAR_LIFT_1(Sqrt)
SKLAR_LIFT_2(Add)
SKLAR_LIFT_2(Sub)
SKLAR_LIFT_2(Mul)
SKLAR_LIFT_2(Div)
SKLAR_LIFT_2(Min)
SKLAR_LIFT_2(Max)
SKLAR_LIFT_3(MulAdd)
SKLAR_LIFT_3(NegMulAdd)
SKLAR_LIFT_COMPARISON(Lt)
SKLAR_LIFT_COMPARISON(Le)
SKLAR_LIFT_COMPARISON(Gt)
SKLAR_LIFT_COMPARISON(Ge)
SKLAR_LIFT_FUNCTION(exp)
SKLAR_LIFT_FUNCTION(expm1)
SKLAR_LIFT_FUNCTION(log)
SKLAR_LIFT_FUNCTION(log1p)
SKLAR_LIFT_FUNCTION_2(log_of_complement)

#undef SKLAR_LIFT_1
#undef SKLAR_LIFT_2
#undef SKLAR_LIFT_3
#undef SKLAR_LIFT_COMPARISON
#undef SKLAR_LIFT_FUNCTION
#undef SKLAR_LIFT_FUNCTION_2

template <class D>
HWY_INLINE Vec<D> Set(D, double x) {
  Vec<D> result;
  SKLAR_FOR_EACH_PART result.part[i] = hn::Set(typename D::Part(), static_cast<typename D::Scalar>(x));
  return result;
}

template <class D>
HWY_INLINE Vec<D> Zero(D d) {
  return Set(d, 0.0);
}

template <class D>
HWY_INLINE Vec<D> NaN(D) {
  Vec<D> result;
  SKLAR_FOR_EACH_PART result.part[i] = hn::NaN(typename D::Part());
  return result;
}

/// Where the numbers in memory are doubles: change of them before they are rounded to the lanes' type.
struct Unchanged {
  template <class V>
  HWY_INLINE V operator()(V x) const {
    return x;
  }
};
struct OneMinus {
  template <class V>
  HWY_INLINE V operator()(V x) const {
    return hn::Sub(hn::Set(hn::DFromV<V>(), 1.0), x);
  }
};

template <class Change>
HWY_INLINE hn::Vec<hn::ScalableTag<double>> load(hn::ScalableTag<double> d, const double* from, Change change) {
  return change(hn::LoadU(d, from));
}

template <class Change>
HWY_INLINE hn::Vec<hn::ScalableTag<float>> load(hn::ScalableTag<float> d, const double* from, Change change) {
  const hn::ScalableTag<double> wide;
  const hn::Rebind<float, decltype(wide)> half;
  const auto low = hn::DemoteTo(half, change(hn::LoadU(wide, from)));
#if HWY_TARGET == HWY_SCALAR
  (void)d;
  return low;
#else
  return hn::Combine(d, hn::DemoteTo(half, change(hn::LoadU(wide, from + hn::Lanes(wide)))), low);
#endif
}

HWY_INLINE void store(hn::Vec<hn::ScalableTag<double>> x, hn::ScalableTag<double> d, double* to) {
  hn::StoreU(x, d, to);
}

HWY_INLINE void store(hn::Vec<hn::ScalableTag<float>> x, hn::ScalableTag<float>, double* to) {
  const hn::ScalableTag<double> wide;
#if HWY_TARGET == HWY_SCALAR
  hn::StoreU(hn::PromoteTo(wide, x), wide, to);
#else
  const hn::Rebind<float, decltype(wide)> half;
  hn::StoreU(hn::PromoteTo(wide, hn::LowerHalf(half, x)), wide, to);
  hn::StoreU(hn::PromoteTo(wide, hn::UpperHalf(half, x)), wide, to + hn::Lanes(wide));
#endif
}

template <class D, class Change = Unchanged>
HWY_INLINE Vec<D> load(D, const double* from, Change change = {}) {
  const typename D::Part d;
  Vec<D> result;
  SKLAR_FOR_EACH_PART result.part[i] = load(d, from + static_cast<std::size_t>(i) * hn::Lanes(d), change);
  return result;
}

template <class D>
HWY_INLINE void store(const Vec<D>& x, D, double* to) {
  const typename D::Part d;
  SKLAR_FOR_EACH_PART store(x.part[i], d, to + static_cast<std::size_t>(i) * hn::Lanes(d));
}

template <class D>
HWY_INLINE Mask<D> And(const Mask<D>& a, const Mask<D>& b) {
  Mask<D> result;
  SKLAR_FOR_EACH_PART result.part[i].mask = hn::And(a.part[i].mask, b.part[i].mask);
  return result;
}

template <class D>
HWY_INLINE Mask<D> Not(const Mask<D>& a) {
  Mask<D> result;
  SKLAR_FOR_EACH_PART result.part[i].mask = hn::Not(a.part[i].mask);
  return result;
}

template <class D>
HWY_INLINE bool AllFalse(D, const Mask<D>& a) {
  bool none = true;
  SKLAR_FOR_EACH_PART none = hn::AllFalse(typename D::Part(), a.part[i].mask) && none;
  return none;
}

template <class D>
HWY_INLINE Vec<D> IfThenElse(const Mask<D>& mask, const Vec<D>& yes, const Vec<D>& no) {
  Vec<D> result;
  SKLAR_FOR_EACH_PART result.part[i] = hn::IfThenElse(mask.part[i].mask, yes.part[i], no.part[i]);
  return result;
}

template <class D>
HWY_INLINE Vec<D> IfThenElseZero(const Mask<D>& mask, const Vec<D>& yes) {
  Vec<D> result;
  SKLAR_FOR_EACH_PART result.part[i] = hn::IfThenElseZero(mask.part[i].mask, yes.part[i]);
  return result;
}

template <class D>
struct Exponential {
  Vec<D> exp, expm1;
};

template <class D>
HWY_INLINE Exponential<D> exponential(D, const Vec<D>& x) {
  Exponential<D> result;
  SKLAR_FOR_EACH_PART {
    const auto e = simd::HWY_NAMESPACE::exponential(typename D::Part(), x.part[i]);
    result.exp.part[i] = e.exp;
    result.expm1.part[i] = e.expm1;
  }
  return result;
}

#undef SKLAR_FOR_EACH_PART

}  // namespace pack

/// Where the formulas of rows are: Highway's functions are those on packs.
namespace formulas {

namespace hn = pack;
using pack::Exponential, pack::Mask, pack::Vec;

}  // namespace formulas
}  // namespace sklar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
