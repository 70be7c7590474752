// Where the rows of a block stand: coordinates, weights of splines and of the nodes of the lattice, for the kernel of
// the refined model. Included once for each instruction set.

#if defined(SKLAR_BRDF_MODEL_REFINED_BLOCK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKLAR_BRDF_MODEL_REFINED_BLOCK_INL_H_
#undef SKLAR_BRDF_MODEL_REFINED_BLOCK_INL_H_
#else
#define SKLAR_BRDF_MODEL_REFINED_BLOCK_INL_H_
#endif

#include <hwy/highway.h>

#include "brdf/model/lattice.hpp"
#include "brdf/model/refined_kernel.hpp"
#include "brdf/model/spline.hpp"
#include "brdf/model/warp.hpp"
#include "copula/simd/math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sklar::brdf::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace sn = sklar::simd::HWY_NAMESPACE;

constexpr std::ptrdiff_t kBlock = 32;  // rows; so many that the chains of their divisions and roots overlap
constexpr std::ptrdiff_t kMost = kMostComponents;
constexpr std::ptrdiff_t kPair = 2 * kMost;
using D = hn::CappedTag<float, kPair>;
using V = hn::Vec<D>;
using Double = hn::CappedTag<double, kPair / 2>;
using DoubleV = hn::Vec<Double>;
using OfDouble = hn::Rebind<float, Double>;
constexpr auto kLanes = static_cast<std::ptrdiff_t>(hn::MaxLanes(D()));
constexpr auto kDoubles = static_cast<std::ptrdiff_t>(hn::MaxLanes(Double()));
static_assert(kBlock % kLanes == 0 && kBlock % kDoubles == 0);

constexpr auto kParts = static_cast<std::size_t>(kPair / kLanes);

/// Four numbers of each row of a block.
struct Four {
  HWY_ALIGN float numbers[4][kBlock];

  template <class Tag, class Numbers>
  HWY_INLINE void store(Tag d, std::ptrdiff_t at, Numbers first, Numbers second, Numbers third, Numbers fourth) {
    hn::StoreU(first, d, numbers[0] + at);
    hn::StoreU(second, d, numbers[1] + at);
    hn::StoreU(third, d, numbers[2] + at);
    hn::StoreU(fourth, d, numbers[3] + at);
  }
  /// One of a row in all lanes.
  HWY_INLINE V get(int which, std::ptrdiff_t row) const { return hn::Set(D(), numbers[which][row]); }
};

/// Two numbers of each component.
struct Pair {
  V part[kParts];

  static HWY_INLINE Pair of(V first, V second) {
    Pair result;
    for (std::size_t i = 0; i < kParts; ++i) {
      if constexpr (kParts == 1) {
        result.part[i] = hn::IfThenElse(hn::FirstN(D(), kMostComponents), first, second);
      } else {
        result.part[i] = i < kParts / 2 ? first : second;
      }
    }
    return result;
  }
  static HWY_INLINE Pair load(const float* from) {
    Pair result;
    for (std::size_t i = 0; i < kParts; ++i) result.part[i] = hn::LoadU(D(), from + i * hn::MaxLanes(D()));
    return result;
  }
  HWY_INLINE void store(float* to) const {
    for (std::size_t i = 0; i < kParts; ++i) hn::StoreU(part[i], D(), to + i * hn::MaxLanes(D()));
  }
  HWY_INLINE Pair plus(const Pair& other) const {
    Pair result;
    for (std::size_t i = 0; i < kParts; ++i) result.part[i] = hn::Add(part[i], other.part[i]);
    return result;
  }
  HWY_INLINE Pair times(const Pair& other) const {
    Pair result;
    for (std::size_t i = 0; i < kParts; ++i) result.part[i] = hn::Mul(part[i], other.part[i]);
    return result;
  }
  HWY_INLINE Pair times(V factor) const {
    Pair result;
    for (std::size_t i = 0; i < kParts; ++i) result.part[i] = hn::Mul(part[i], factor);
    return result;
  }
  HWY_INLINE Pair plus_times(const Pair& a, const Pair& b) const {
    Pair result;
    for (std::size_t i = 0; i < kParts; ++i) result.part[i] = hn::MulAdd(a.part[i], b.part[i], part[i]);
    return result;
  }
  HWY_INLINE Pair plus_times(V a, const Pair& b) const {
    Pair result;
    for (std::size_t i = 0; i < kParts; ++i) result.part[i] = hn::MulAdd(a, b.part[i], part[i]);
    return result;
  }
};

/// The interval of `count` on [0,1] in which x lies, at an edge either; from 0 to count - 1 also where directions below
/// the horizon have led elsewhere.
template <class Tag>
HWY_INLINE hn::Vec<hn::RebindToSigned<Tag>> interval_of(Tag d, hn::Vec<Tag> x, int count) {
  constexpr float kRound = 0x1.8p23F;  // x + kRound rounds x to an integer
  constexpr int kRoundBits = 0x4b400000;
  const hn::RebindToSigned<Tag> whole;
  const auto middle = hn::MulSub(x, hn::Set(d, static_cast<float>(count)), hn::Set(d, 0.5F));
  const auto rounded = hn::Sub(hn::BitCast(whole, hn::Add(middle, hn::Set(d, kRound))), hn::Set(whole, kRoundBits));
  return hn::Max(hn::Zero(whole), hn::Min(rounded, hn::Set(whole, count - 1)));
}

/// Where the rows of a block stand on a spline's axis: the first of its coefficients and their weights.
struct SplineAxis {
  HWY_ALIGN int first[kBlock];
  Four weights;

  template <class Tag, class Numbers = hn::Vec<Tag>>
  /// @param lost what x lacks by rounding.
  HWY_INLINE void locate(Tag d, std::ptrdiff_t at, Numbers x, Numbers lost, int count) {
    const int intervals = count - kSplineOrder + 1;
    const Numbers along = hn::Set(d, static_cast<float>(intervals));
    const auto cell = interval_of(d, x, intervals);
    const Numbers t = hn::MulAdd(lost, along, hn::MulSub(x, along, hn::ConvertTo(d, cell)));
    const Numbers s = hn::Sub(hn::Set(d, 1.0F), t);
    const Numbers sixth = hn::Set(d, 1.0F / 6), three = hn::Set(d, 3.0F), six = hn::Set(d, 6.0F),
                  four = hn::Set(d, 4.0F);
    const Numbers t2 = hn::Mul(t, t), s2 = hn::Mul(s, s);
    hn::StoreU(cell, hn::RebindToSigned<Tag>(), first + at);
    weights.store(d, at, hn::Mul(sixth, hn::Mul(s, s2)),
                  hn::Mul(sixth, hn::MulAdd(t2, hn::MulSub(three, t, six), four)),
                  hn::Mul(sixth, hn::MulAdd(s2, hn::MulSub(three, s, six), four)), hn::Mul(sixth, hn::Mul(t, t2)));
  }
};

/// A node of the lattice and the share of the next.
template <class Tag>
struct Node {
  hn::Vec<hn::RebindToSigned<Tag>> first;
  hn::Vec<Tag> share;

  HWY_INLINE Node(Tag d, hn::Vec<Tag> x, int nodes) {
    const auto along = hn::Set(d, static_cast<float>(nodes - 1));
    first = interval_of(d, x, nodes - 1);
    share = hn::MulSub(x, along, hn::ConvertTo(d, first));
  }
};

/// Sums and differences of the coordinates of rows side by side.
template <class Tag>
struct Sums {
  hn::Vec<Tag> across, z, square, gap, rise;  // across: x^2 + y^2 of the sum
};

/// Those of a block. They cancel, so they are taken in double.
struct SumRows {
  HWY_ALIGN float across[kBlock], z[kBlock], square[kBlock], gap[kBlock], rise[kBlock];
  HWY_ALIGN double lowest[kBlock];  // z of either direction

  HWY_INLINE void load(const DirectionRows& wo, const DirectionRows& wi) {
    const Double d;
    const OfDouble f;
    for (std::ptrdiff_t i = 0; i < kBlock; i += kDoubles) {
      DoubleV sum[3], between[3];
      for (std::ptrdiff_t k = 0; k < 3; ++k) {
        const DoubleV in = hn::LoadU(d, wi.first + k * wi.stride + i), out = hn::LoadU(d, wo.first + k * wo.stride + i);
        sum[k] = hn::Add(in, out);
        between[k] = hn::Sub(in, out);
        if (k == 2) hn::StoreU(hn::Min(in, out), d, lowest + i);
      }
      const auto store = [&](DoubleV value, float* to) { hn::StoreU(hn::DemoteTo(f, value), f, to + i); };
      const DoubleV across_sum = hn::MulAdd(sum[0], sum[0], hn::Mul(sum[1], sum[1]));
      const DoubleV across_gap = hn::MulAdd(between[0], between[0], hn::Mul(between[1], between[1]));
      store(across_sum, across);
      store(sum[2], z);
      store(hn::MulAdd(sum[2], sum[2], across_sum), square);
      store(hn::MulAdd(between[2], between[2], across_gap), gap);
      store(between[2], rise);
    }
  }
  HWY_INLINE Sums<D> at(std::ptrdiff_t i) const {
    const D d;
    return {hn::LoadU(d, across + i), hn::LoadU(d, z + i), hn::LoadU(d, square + i), hn::LoadU(d, gap + i),
            hn::LoadU(d, rise + i)};
  }
};

using OneRow = hn::CappedTag<float, 1>;
HWY_INLINE Sums<OneRow> sums_of_one(const DirectionRows& wo, const DirectionRows& wi) {
  const hn::CappedTag<double, 1> d;
  using One = hn::Vec<decltype(d)>;
  One sum[3], between[3];
  for (std::ptrdiff_t k = 0; k < 3; ++k) {
    const One in = hn::Set(d, wi.first[k * wi.stride]), out = hn::Set(d, wo.first[k * wo.stride]);
    sum[k] = hn::Add(in, out);
    between[k] = hn::Sub(in, out);
  }
  const One across_sum = hn::MulAdd(sum[0], sum[0], hn::Mul(sum[1], sum[1]));
  const One across_gap = hn::MulAdd(between[0], between[0], hn::Mul(between[1], between[1]));
  const auto set = [](One value) { return hn::Set(OneRow(), static_cast<float>(hn::GetLane(value))); };
  return {set(across_sum), set(sum[2]), set(hn::MulAdd(sum[2], sum[2], across_sum)),
          set(hn::MulAdd(between[2], between[2], across_gap)), set(between[2])};
}

/// Coordinates and weights of the rows of a block.
struct Block {
  SplineAxis half, difference;
  HWY_ALIGN int half_node[kBlock], difference_node[kBlock], azimuth_node[kBlock];
  Four corners;  // weights of the nodes: both of half at the first of difference, at the second
  HWY_ALIGN float next[kBlock], azimuth_next[kBlock];  // shares of the second nodes of difference and of azimuth
  HWY_ALIGN float azimuth[kBlock], product[kBlock], square[kBlock];  // z, z (z - 1/2), (z - 1/2)^2 of azimuth z

  /// The rows from i on, as many as there are lanes.
  template <class Tag>
  HWY_INLINE void locate(Tag d, const RefinedTables& t, std::ptrdiff_t i, const Sums<Tag>& s) {
    using Numbers = hn::Vec<Tag>;
    const Numbers one = hn::Set(d, 1.0F), quarter = hn::Set(d, 0.25F), width = hn::Set(d, t.width);
    const Numbers sin2_d = hn::Mul(quarter, s.gap);
    const Numbers root = hn::Sqrt(s.square);
    const Numbers inverse = hn::Div(one, hn::MulAdd(hn::MulAdd(s.z, root, s.square), width, s.across));
    const Numbers share = hn::Mul(hn::Mul(s.across, hn::Add(one, width)), inverse);
    const Numbers above = hn::Mul(hn::Mul(width, s.z), hn::Mul(hn::Add(root, s.z), inverse));  // 1 - share
    Numbers at_half = hn::Sqrt(hn::Sqrt(share));
    // Towards half = 1, where a model is steepest, what is lost in rounding it: (share - half^4) / 4.
    const Numbers below_one = hn::Mul(hn::Sub(one, at_half), hn::Add(one, at_half));
    Numbers lost = hn::Mul(quarter, hn::Sub(hn::MulAdd(below_one, hn::Mul(at_half, at_half), below_one), above));
    const Numbers left = hn::Div(hn::Mul(quarter, s.square), hn::Add(one, hn::Sqrt(sin2_d)));
    const Numbers reach = hn::MulAdd(s.across, sin2_d, hn::Mul(hn::Set(d, static_cast<float>(kPole)), s.square));
    const Numbers fall = hn::Mul(quarter, hn::Mul(hn::Mul(s.rise, s.rise), s.square));
    Numbers at_difference = hn::Max(hn::Zero(d), hn::Sub(one, hn::Sqrt(left)));
    if (t.on_part) {
      at_half = on_axis(d, t.half_axis, at_half);
      at_difference = on_axis(d, t.difference_axis, at_difference);
      lost = hn::Mul(hn::Set(d, t.half_axis.stretch), lost);
    }
    place(d, t, i, at_half, lost, at_difference, hn::Div(fall, reach));
  }

 private:
  template <class Tag, class Numbers = hn::Vec<Tag>>
  static HWY_INLINE Numbers on_axis(Tag d, const PlacedAxis& axis, Numbers x) {
    const Numbers placed = hn::MulSub(x, hn::Set(d, axis.stretch), hn::Set(d, axis.low));
    return hn::Max(hn::Zero(d), hn::Min(placed, hn::Set(d, 1.0F)));
  }

  template <class Tag, class Numbers = hn::Vec<Tag>>
  HWY_INLINE void place(Tag d, const RefinedTables& t, std::ptrdiff_t i, Numbers at_half, Numbers lost,
                        Numbers at_difference, Numbers at_azimuth) {
    const hn::RebindToSigned<Tag> whole;
    half.locate(d, i, at_half, lost, t.half);
    difference.locate(d, i, at_difference, hn::Zero(d), t.difference);
    const Node<Tag> h(d, at_half, Lattice::half), p(d, at_difference, Lattice::difference);
    const Numbers h0 = hn::Sub(hn::Set(d, 1.0F), h.share), p0 = hn::Sub(hn::Set(d, 1.0F), p.share);
    hn::StoreU(h.first, whole, half_node + i);
    hn::StoreU(p.first, whole, difference_node + i);
    corners.store(d, i, hn::Mul(p0, h0), hn::Mul(p0, h.share), hn::Mul(p.share, h0), hn::Mul(p.share, h.share));
    hn::StoreU(p.share, d, next + i);
    hn::StoreU(at_azimuth, d, azimuth + i);
    const Numbers from_middle = hn::Sub(at_azimuth, hn::Set(d, 0.5F));
    hn::StoreU(hn::Mul(at_azimuth, from_middle), d, product + i);
    hn::StoreU(hn::Mul(from_middle, from_middle), d, square + i);
    if (t.coupling.empty()) return;
    const Node<Tag> a(d, at_azimuth, Lattice::azimuth);
    hn::StoreU(a.first, whole, azimuth_node + i);
    hn::StoreU(a.share, d, azimuth_next + i);
  }
};

}  // namespace sklar::brdf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
