// The vector kernel of the refined model, a block of rows at a time in three passes: the coordinates and weights of all
// rows side by side; row by row the logs of all components side by side; exponentials and sums, rows side by side
// again.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "brdf/model/refined_kernel_simd.cpp"
#include "copula/instruction_sets.hpp"
//
#include <hwy/foreach_target.h>
//
#include <algorithm>
#include <cstring>

#include "brdf/model/refined_block-inl.h"
#include "brdf/model/refined_kernel.hpp"
#include "copula/simd/math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sklar::brdf::HWY_NAMESPACE {

/// The log of green of a row, in two parts to be added.
HWY_INLINE Pair log_parts(const RefinedTables& t, const Block& b, std::ptrdiff_t row) {
  const Four &across = b.half.weights, &along = b.difference.weights;
  const Pair low = Pair::of(across.get(0, row), across.get(1, row));
  const Pair high = Pair::of(across.get(2, row), across.get(3, row));
  const float* shape = t.shape.data() + (std::ptrdiff_t{b.difference.first[row]} * t.half + b.half.first[row]) * kMost;
  const std::ptrdiff_t column = t.half * kMost;
  const auto along_half = [&](int j) {
    const float* from = shape + j * column;
    return low.times(Pair::load(from)).plus_times(high, Pair::load(from + kPair));
  };
  const Pair first = along_half(0).times(along.get(0, row)).plus_times(along.get(1, row), along_half(1));
  Pair sum = along_half(2).times(along.get(2, row)).plus_times(along.get(3, row), along_half(3));
  const std::ptrdiff_t step = t.powers_pairs * kPair;
  const float* powers = t.powers.data() + b.difference_node[row] * step;
  const V square = hn::Set(D(), b.square[row]);
  const V next = hn::Set(D(), b.next[row]), here = hn::Sub(hn::Set(D(), 1.0F), next);
  Pair z = Pair::of(hn::Set(D(), b.azimuth[row]), hn::Set(D(), b.product[row]));
  for (int m = 0; m < t.powers_pairs; ++m, powers += kPair) {
    sum = sum.plus_times(z, Pair::load(powers).times(here).plus_times(next, Pair::load(powers + step)));
    z = z.times(square);
  }
  return sum.plus(first);
}

/// At the four nodes around a row's half and difference.
HWY_INLINE Pair between(const Block& b, std::ptrdiff_t row, const float* first, std::ptrdiff_t half,
                        std::ptrdiff_t difference) {
  Pair sum = Pair::load(first).times(b.corners.get(0, row));
  sum = sum.plus_times(b.corners.get(1, row), Pair::load(first + half));
  sum = sum.plus_times(b.corners.get(2, row), Pair::load(first + difference));
  return sum.plus_times(b.corners.get(3, row), Pair::load(first + difference + half));
}

/// The log of green in two parts to be added, and red and blue over green.
HWY_INLINE void evaluate_row(const RefinedTables& t, const Block& b, std::ptrdiff_t row, float* logs, float* colour) {
  Pair sum = log_parts(t, b, row);
  if (!t.coupling.empty()) {
    constexpr std::ptrdiff_t kHalf = Lattice::azimuth * kMost, kDifference = Lattice::half * kHalf;
    const float* node = t.coupling.data() + b.difference_node[row] * kDifference + b.half_node[row] * kHalf +
                        b.azimuth_node[row] * kMost;
    const V next = hn::Set(D(), b.azimuth_next[row]);
    sum = sum.plus_times(Pair::of(hn::Sub(hn::Set(D(), 1.0F), next), next), between(b, row, node, kHalf, kDifference));
  }
  sum.store(logs);
  constexpr std::ptrdiff_t kDifference = Lattice::half * kPair;
  const float* node = t.colour.data() + b.difference_node[row] * kDifference + b.half_node[row] * kPair;
  between(b, row, node, kPair, kDifference).store(colour);
}

/// Adds the two parts of the log of each component.
HWY_INLINE void add_parts(const float* logs, float* green) {
  const hn::CappedTag<float, kMostComponents> d;
  for (std::ptrdiff_t k = 0; k < kMostComponents; k += static_cast<std::ptrdiff_t>(hn::MaxLanes(d))) {
    hn::StoreU(hn::Add(hn::LoadU(d, logs + k), hn::LoadU(d, logs + kMostComponents + k)), d, green + k);
  }
}

constexpr std::ptrdiff_t kPartial = 4;  // sums of a row, to be added

/// Sums of red, green and blue over every fourth component.
HWY_INLINE void partial_sums(const float* green, const float* colour, float* red_sum, float* sum, float* blue_sum) {
  const hn::CappedTag<float, kPartial> d;
  for (std::ptrdiff_t i = 0; i < kPartial; i += static_cast<std::ptrdiff_t>(hn::MaxLanes(d))) {
    auto g = hn::Zero(d), r = hn::Zero(d), b = hn::Zero(d);
    for (std::ptrdiff_t k = i; k < kMostComponents; k += kPartial) {
      const auto part = hn::LoadU(d, green + k);
      g = hn::Add(g, part);
      r = hn::MulAdd(part, hn::LoadU(d, colour + k), r);
      b = hn::MulAdd(part, hn::LoadU(d, colour + kMostComponents + k), b);
    }
    hn::StoreU(r, d, red_sum + i);
    hn::StoreU(g, d, sum + i);
    hn::StoreU(b, d, blue_sum + i);
  }
}

/// The components of the rows of a block.
struct Terms {
  HWY_ALIGN float logs[kBlock * kPair];  // of green, in two parts to be added
  HWY_ALIGN float green[kBlock * kMostComponents];
  HWY_ALIGN float colour[kBlock * kPair];
  HWY_ALIGN float sums[3][kBlock * kPartial];

  HWY_INLINE void add_up(std::ptrdiff_t rows) {
    for (std::ptrdiff_t row = 0; row < rows; ++row) add_parts(logs + row * kPair, green + row * kMostComponents);
    for (std::ptrdiff_t i = 0; i < rows * kMostComponents; i += kLanes) {
      hn::StoreU(sn::exp(D(), hn::LoadU(D(), green + i)), D(), green + i);
    }
    for (std::ptrdiff_t row = 0; row < rows; ++row) {
      const std::ptrdiff_t at = kPartial * row;
      partial_sums(green + row * kMostComponents, colour + row * kPair, sums[0] + at, sums[1] + at, sums[2] + at);
    }
  }

  HWY_INLINE void store(const SumRows& directions, double* out, std::ptrdiff_t stride) const {
    const Double d;
    for (std::ptrdiff_t c = 0; c < 3; ++c) {
      HWY_ALIGN float total[kBlock];
      for (std::ptrdiff_t i = 0; i < kBlock; i += kLanes) {
        V part[4];
        hn::LoadInterleaved4(D(), sums[c] + kPartial * i, part[0], part[1], part[2], part[3]);
        hn::StoreU(hn::Add(hn::Add(part[0], part[1]), hn::Add(part[2], part[3])), D(), total + i);
      }
      for (std::ptrdiff_t i = 0; i < kBlock; i += kDoubles) {
        const auto above = hn::Gt(hn::LoadU(d, directions.lowest + i), hn::Zero(d));
        const DoubleV value = hn::PromoteTo(d, hn::LoadU(OfDouble(), total + i));
        hn::StoreU(hn::IfThenElseZero(above, value), d, out + c * stride + i);
      }
    }
  }
};

struct Workspace {
  SumRows sums;
  Block block;
  Terms terms;

  /// kBlock rows of directions, of which the first `rows` count.
  HWY_INLINE void evaluate(const RefinedTables& t, const DirectionRows& wo, const DirectionRows& wi,
                           std::ptrdiff_t rows, double* out, std::ptrdiff_t stride) {
    sums.load(wo, wi);
    for (std::ptrdiff_t i = 0; i < kBlock; i += kLanes) block.locate(D(), t, i, sums.at(i));
    for (std::ptrdiff_t row = 0; row < rows; ++row) {
      evaluate_row(t, block, row, terms.logs + row * kPair, terms.colour + row * kPair);
    }
    terms.add_up(rows);
    terms.store(sums, out, stride);
  }
};

/// The same numbers as in a block.
void evaluate_one(const RefinedTables& t, const DirectionRows& wo, const DirectionRows& wi, double* out,
                  std::ptrdiff_t stride) {
  const hn::CappedTag<float, kMostComponents> d;
  if (!(wo.first[2 * wo.stride] > 0 && wi.first[2 * wi.stride] > 0)) {
    for (std::ptrdiff_t c = 0; c < 3; ++c) out[c * stride] = 0;
    return;
  }
  Block block;
  HWY_ALIGN float logs[kPair], colour[kPair], green[kMostComponents], sums[3][kPartial];
  block.locate(OneRow(), t, 0, sums_of_one(wo, wi));
  evaluate_row(t, block, 0, logs, colour);
  add_parts(logs, green);
  for (std::ptrdiff_t k = 0; k < kMostComponents; k += static_cast<std::ptrdiff_t>(hn::MaxLanes(d))) {
    hn::StoreU(sn::exp(d, hn::LoadU(d, green + k)), d, green + k);
  }
  partial_sums(green, colour, sums[0], sums[1], sums[2]);
  const auto total = [&](std::ptrdiff_t c) HWY_ATTR {
    return static_cast<double>((sums[c][0] + sums[c][1]) + (sums[c][2] + sums[c][3]));
  };
  if (stride != 1) {
    for (std::ptrdiff_t c = 0; c < 3; ++c) out[c * stride] = total(c);
    return;
  }
  // Red and green in one store: who multiplies an Rgb loads both at once, and waits until two stores have left the
  // pipeline.
  using Two = double __attribute__((vector_size(2 * sizeof(double))));
  const Two first{total(0), total(1)};
  std::memcpy(out, &first, sizeof first);
  out[2] = total(2);
}

/// Fewer rows than a block, copied.
struct Rest {
  double wo[3][kBlock] = {}, wi[3][kBlock] = {}, out[3][kBlock];

  void copy(const DirectionRows& from, std::ptrdiff_t first, std::ptrdiff_t rows, double (*to)[kBlock]) const {
    for (std::ptrdiff_t k = 0; k < 3; ++k) std::copy_n(from.first + k * from.stride + first, rows, to[k]);
  }
};

void evaluate(const RefinedTables& t, const DirectionRows& wo, const DirectionRows& wi, std::ptrdiff_t count,
              double* out, std::ptrdiff_t stride) {
  if (count == 1) return evaluate_one(t, wo, wi, out, stride);
  Workspace workspace;
  std::ptrdiff_t first = 0;
  for (; first + kBlock <= count; first += kBlock) {
    workspace.evaluate(t, {wo.first + first, wo.stride}, {wi.first + first, wi.stride}, kBlock, out + first, stride);
  }
  const std::ptrdiff_t rows = count - first;
  if (rows == 0) return;
  std::fill(std::begin(workspace.terms.logs), std::end(workspace.terms.logs), 0.0F);
  std::fill(&workspace.terms.sums[0][0], &workspace.terms.sums[0][0] + 3 * kBlock * kPartial, 0.0F);
  Rest rest;
  rest.copy(wo, first, rows, rest.wo);
  rest.copy(wi, first, rows, rest.wi);
  workspace.evaluate(t, {rest.wo[0], kBlock}, {rest.wi[0], kBlock}, rows, rest.out[0], kBlock);
  for (std::ptrdiff_t c = 0; c < 3; ++c) std::copy_n(rest.out[c], rows, out + c * stride + first);
}

}  // namespace sklar::brdf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sklar::brdf {
namespace {
HWY_EXPORT(evaluate);
}

void evaluate_refined(const RefinedTables& tables, const DirectionRows& wo, const DirectionRows& wi,
                      std::ptrdiff_t count, double* out, std::ptrdiff_t stride) {
  HWY_DYNAMIC_DISPATCH(evaluate)(tables, wo, wi, count, out, stride);
}

}  // namespace sklar::brdf
#endif
