// The vector kernel of the refined model. The coordinates and spline weights of a block of rows are found side by side;
// then row by row the log densities of all components side by side.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "brdf/model/refined_kernel_simd.cpp"
#include "copula/instruction_sets.hpp"
//
#include <hwy/foreach_target.h>
//
#include <algorithm>

#include "brdf/model/coupling.hpp"
#include "brdf/model/refined_kernel.hpp"
#include "brdf/model/refined_structure.hpp"
#include "brdf/model/spline.hpp"
#include "brdf/model/warp.hpp"
#include "copula/simd/math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sklar::brdf::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace sn = sklar::simd::HWY_NAMESPACE;

constexpr std::ptrdiff_t kBlock = 16;  // rows
using D = hn::CappedTag<float, kBlock>;
using V = hn::Vec<D>;
using Components = hn::CappedTag<float, kMostComponents>;
constexpr std::size_t kParts = kMostComponents / hn::MaxLanes(Components());

/// The numbers of all components.
struct Lanes {
  hn::Vec<Components> part[kParts];

  static HWY_INLINE Lanes zero() {
    Lanes result;
    for (auto& part : result.part) part = hn::Zero(Components());
    return result;
  }
  HWY_INLINE void add(float weight, const float* from) {
    const Components d;
    for (std::size_t i = 0; i < kParts; ++i) {
      part[i] = hn::MulAdd(hn::Set(d, weight), hn::LoadU(d, from + i * hn::MaxLanes(d)), part[i]);
    }
  }
  HWY_INLINE Lanes plus(const Lanes& other) const {
    Lanes result;
    for (std::size_t i = 0; i < kParts; ++i) result.part[i] = hn::Add(part[i], other.part[i]);
    return result;
  }
  HWY_INLINE Lanes times(float factor) const {
    Lanes result;
    for (std::size_t i = 0; i < kParts; ++i) result.part[i] = hn::Mul(part[i], hn::Set(Components(), factor));
    return result;
  }
  HWY_INLINE float sum_of_exp() const {
    const Components d;
    auto sum = hn::Zero(d);
    for (const auto& x : part) sum = hn::Add(sum, sn::exp(d, x));
    return hn::GetLane(hn::SumOfLanes(d, sum));
  }
};

/// Where the rows of a block stand on one axis: the first of the coefficients and their weights.
struct Axis {
  HWY_ALIGN int first[kBlock];
  HWY_ALIGN float weight[kSplineOrder][kBlock];

  HWY_INLINE void locate(const float* x, std::ptrdiff_t at, int count) {
    const D d;
    const hn::RebindToSigned<D> di;
    const int intervals = count - kSplineOrder + 1;
    const V position = hn::Mul(hn::LoadU(d, x + at), hn::Set(d, static_cast<float>(intervals)));
    const auto cell = hn::Min(hn::ConvertTo(di, position), hn::Set(di, intervals - 1));
    const V t = hn::Sub(position, hn::ConvertTo(d, cell)), s = hn::Sub(hn::Set(d, 1.0F), t);
    const V sixth = hn::Set(d, 1.0F / 6), three = hn::Set(d, 3.0F), six = hn::Set(d, 6.0F), four = hn::Set(d, 4.0F);
    const V t2 = hn::Mul(t, t), s2 = hn::Mul(s, s);
    hn::StoreU(cell, di, first + at);
    hn::StoreU(hn::Mul(sixth, hn::Mul(s, s2)), d, weight[0] + at);
    hn::StoreU(hn::Mul(sixth, hn::MulAdd(t2, hn::Sub(hn::Mul(three, t), six), four)), d, weight[1] + at);
    hn::StoreU(hn::Mul(sixth, hn::MulAdd(s2, hn::Sub(hn::Mul(three, s), six), four)), d, weight[2] + at);
    hn::StoreU(hn::Mul(sixth, hn::Mul(t, t2)), d, weight[3] + at);
  }
};

/// Coordinates and weights of the rows of a block.
struct Block {
  HWY_ALIGN float sum_x[kBlock], sum_y[kBlock], sum_z[kBlock], square[kBlock], gap[kBlock], rise[kBlock];
  HWY_ALIGN float half[kBlock], difference[kBlock], azimuth[kBlock];
  Axis shape_half, shape_difference, colour_half, colour_difference, powers;

  /// Sums and differences cancel, so they are taken in double.
  HWY_INLINE void load(const DirectionRows& wo, const DirectionRows& wi, std::ptrdiff_t row, std::ptrdiff_t rows) {
    for (std::ptrdiff_t i = 0; i < kBlock; ++i) {
      const double* o = wo.first + row + std::min(i, rows - 1);
      const double* w = wi.first + row + std::min(i, rows - 1);
      double sum[3], between[3];
      for (std::ptrdiff_t k = 0; k < 3; ++k) {
        sum[k] = w[k * wi.stride] + o[k * wo.stride];
        between[k] = w[k * wi.stride] - o[k * wo.stride];
      }
      sum_x[i] = static_cast<float>(sum[0]);
      sum_y[i] = static_cast<float>(sum[1]);
      sum_z[i] = static_cast<float>(sum[2]);
      square[i] = static_cast<float>(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
      gap[i] = static_cast<float>(between[0] * between[0] + between[1] * between[1] + between[2] * between[2]);
      rise[i] = static_cast<float>(between[2]);
    }
  }

  HWY_INLINE void locate(const RefinedTables& t) {
    const D d;
    const V one = hn::Set(d, 1.0F), quarter = hn::Set(d, 0.25F), width = hn::Set(d, t.width);
    for (std::ptrdiff_t i = 0; i < kBlock; i += static_cast<std::ptrdiff_t>(hn::MaxLanes(d))) {
      const V x = hn::LoadU(d, sum_x + i), y = hn::LoadU(d, sum_y + i), z = hn::LoadU(d, sum_z + i);
      const V across = hn::LoadU(d, square + i), fall = hn::LoadU(d, rise + i);
      const V sin2_d = hn::Mul(quarter, hn::LoadU(d, gap + i));
      const V sin2_h = hn::Div(hn::MulAdd(x, x, hn::Mul(y, y)), across);
      const V versed = hn::Div(sin2_h, hn::Add(one, hn::Div(z, hn::Sqrt(across))));
      const V share = hn::Div(hn::Mul(versed, hn::Add(one, width)), hn::Add(versed, width));
      const V left = hn::Div(hn::Mul(quarter, across), hn::Add(one, hn::Sqrt(sin2_d)));
      const V reach = hn::MulAdd(sin2_h, sin2_d, hn::Set(d, static_cast<float>(kPole)));
      hn::StoreU(hn::Sqrt(hn::Sqrt(share)), d, half + i);
      hn::StoreU(hn::Max(hn::Zero(d), hn::Sub(one, hn::Sqrt(left))), d, difference + i);
      hn::StoreU(hn::Div(hn::Mul(quarter, hn::Mul(fall, fall)), reach), d, azimuth + i);
      shape_half.locate(half, i, t.half);
      shape_difference.locate(difference, i, t.difference);
      colour_half.locate(half, i, t.colour_half);
      colour_difference.locate(difference, i, t.colour_difference);
      powers.locate(difference, i, t.azimuth_difference);
    }
  }
};

/// sum of weights times coefficients of a tensor product spline.
HWY_INLINE Lanes tensor(const float* table, int columns, const Axis& across, const Axis& along, std::ptrdiff_t row) {
  Lanes sum = Lanes::zero();
  for (int j = 0; j < kSplineOrder; ++j) {
    const float* from = table + ((along.first[row] + j) * columns + across.first[row]) * kMostComponents;
    for (int i = 0; i < kSplineOrder; ++i) {
      sum.add(along.weight[j][row] * across.weight[i][row], from + i * kMostComponents);
    }
  }
  return sum;
}

HWY_INLINE Lanes azimuth_terms(const RefinedTables& t, const Block& block, std::ptrdiff_t row) {
  Lanes sum = Lanes::zero();
  const float z = block.azimuth[row];
  const int step = t.azimuth * kMostComponents;
  for (int m = t.azimuth - 1; m >= 0; --m) {
    for (int j = 0; j < kSplineOrder; ++j) {
      sum.add(block.powers.weight[j][row],
              t.powers.data() + (block.powers.first[row] + j) * step + m * kMostComponents);
    }
    sum = sum.times(z);
  }
  return sum;
}

struct LatticeAxis {
  int first;
  float weight[2];

  LatticeAxis(float x, int nodes)
      : first(std::min(static_cast<int>(x * static_cast<float>(nodes - 1)), nodes - 2)), weight{} {
    weight[1] = x * static_cast<float>(nodes - 1) - static_cast<float>(first);
    weight[0] = 1 - weight[1];
  }
};

HWY_INLINE Lanes coupling_terms(const RefinedTables& t, const Block& block, std::ptrdiff_t row) {
  Lanes sum = Lanes::zero();
  const LatticeAxis half(block.half[row], CouplingLattice::half);
  const LatticeAxis azimuth(block.azimuth[row], CouplingLattice::azimuth);
  const LatticeAxis difference(block.difference[row], CouplingLattice::difference);
  for (int p = 0; p < 2; ++p) {
    const float* plane = t.coupling.data() +
                         static_cast<std::ptrdiff_t>(difference.first + p) * CouplingLattice::plane * kMostComponents;
    for (int m = 0; m < 2; ++m) {
      for (int n = 0; n < 2; ++n) {
        const int at = CouplingLattice::index(half.first + m, azimuth.first + n);
        sum.add(difference.weight[p] * half.weight[m] * azimuth.weight[n], plane + at * kMostComponents);
      }
    }
  }
  return sum;
}

void evaluate(const RefinedTables& t, const DirectionRows& wo, const DirectionRows& wi, std::ptrdiff_t count,
              double* out, std::ptrdiff_t stride) {
  Block block;
  for (std::ptrdiff_t first = 0; first < count; first += kBlock) {
    const std::ptrdiff_t rows = std::min(kBlock, count - first);
    block.load(wo, wi, first, rows);
    block.locate(t);
    for (std::ptrdiff_t row = 0; row < rows; ++row) {
      Lanes green = tensor(t.shape.data(), t.half, block.shape_half, block.shape_difference, row);
      green = green.plus(azimuth_terms(t, block, row));
      if (!t.coupling.empty()) green = green.plus(coupling_terms(t, block, row));
      const Lanes red = tensor(t.red.data(), t.colour_half, block.colour_half, block.colour_difference, row);
      const Lanes blue = tensor(t.blue.data(), t.colour_half, block.colour_half, block.colour_difference, row);
      double* at = out + first + row;
      at[0] = static_cast<double>(green.plus(red).sum_of_exp());
      at[stride] = static_cast<double>(green.sum_of_exp());
      at[2 * stride] = static_cast<double>(green.plus(blue).sum_of_exp());
    }
  }
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
