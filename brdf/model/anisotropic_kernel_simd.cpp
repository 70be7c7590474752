// The vector kernel of the anisotropic model: rows side by side, component after component.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "brdf/model/anisotropic_kernel_simd.cpp"
#include "copula/instruction_sets.hpp"
//
#include <hwy/foreach_target.h>
//
#include "brdf/model/anisotropic_terms-inl.h"
#include "copula/simd/math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sklar::brdf::HWY_NAMESPACE {

namespace sn = sklar::simd::HWY_NAMESPACE;

HWY_INLINE F dot(const float* coefficients, const F* terms, int count, F sum) {
  for (int n = 0; n < count; ++n) sum = hn::MulAdd(F(coefficients[n]).v, terms[n].v, sum.v);
  return sum;
}

/// The tensor spline of a component.
HWY_INLINE F tensor(const float* table, int columns, const Spline& across, const Spline& along) {
  const PointTag d;
  const hn::RebindToSigned<PointTag> di;
  F sum(0.0F);
  auto at = hn::Add(hn::Mul(along.first, hn::Set(di, columns)), across.first);
  for (int j = 0; j < kSplineOrder; ++j) {
    F row(0.0F);
    for (int i = 0; i < kSplineOrder; ++i) {
      row = hn::MulAdd(across.weight[i].v, hn::GatherIndex(d, table + i, at), row.v);
    }
    sum = hn::MulAdd(along.weight[j].v, row.v, sum.v);
    at = hn::Add(at, hn::Set(di, columns));
  }
  return sum;
}

void evaluate(const AnisotropicTables& t, const DirectionRows& wo, const DirectionRows& wi, std::ptrdiff_t count,
              double* out, std::ptrdiff_t stride) {
  const PointTag d;
  const AnisotropicStructure& s = t.structure;
  F shared[kMostTerms], colours[kMostTerms];
  for (std::ptrdiff_t row = 0; row < count; row += kPointLanes) {
    Pairs pairs;
    pairs.load_rows(wo, wi, row, count - 1);
    find_terms(s, pairs, shared, colours);
    Spline along;
    along.locate(pairs.difference(), s.difference);
    F sums[3] = {0.0F, 0.0F, 0.0F};
    for (std::ptrdiff_t k = 0; k < s.components; ++k) {
      Spline across;
      across.locate(half_coordinate(Distance(t.metric.data() + 5 * k, pairs.h).q, pairs.h[2]), s.half);
      F green = tensor(t.shape.data() + k * s.half * s.difference, s.half, across, along);
      green = dot(t.terms.data() + k * t.shared, shared, t.shared, green);
      const F red = dot(t.red.data() + k * t.colours, colours, t.colours, green);
      const F blue = dot(t.blue.data() + k * t.colours, colours, t.colours, green);
      sums[0] = sums[0] + F(sn::exp(d, red.v));
      sums[1] = sums[1] + F(sn::exp(d, green.v));
      sums[2] = sums[2] + F(sn::exp(d, blue.v));
    }
    const std::ptrdiff_t lanes = std::min(kPointLanes, count - row);
    for (std::ptrdiff_t c = 0; c < 3; ++c) {
      HWY_ALIGN float values[kPointBlock];
      store(sums[c], values);
      for (std::ptrdiff_t lane = 0; lane < lanes; ++lane) {
        out[c * stride + row + lane] = static_cast<double>(values[lane]);
      }
    }
  }
}

void find_points(const AnisotropicStructure& s, const DirectionRows& wo, const DirectionRows& wi, std::ptrdiff_t count,
                 int shared_count, int colour_count, AnisotropicPoints& points) {
  F shared[kMostTerms], colours[kMostTerms];
  const std::ptrdiff_t padded = (count + kPointBlock - 1) / kPointBlock * kPointBlock;
  for (std::ptrdiff_t row = 0; row < padded; row += kPointLanes) {
    Pairs pairs;
    pairs.load_rows(wo, wi, row, count - 1);
    find_terms(s, pairs, shared, colours);
    float* to = points.values.data() + row / kPointBlock * points.numbers * kPointBlock + row % kPointBlock;
    const auto put = [&](const F* numbers, int how_many) {
      for (int n = 0; n < how_many; ++n, to += kPointBlock) store(numbers[n], to);
    };
    put(pairs.h, 3);
    put(shared, shared_count);
    put(colours, colour_count);
  }
}

}  // namespace sklar::brdf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sklar::brdf {
namespace {
HWY_EXPORT(evaluate);
HWY_EXPORT(find_points);
}  // namespace

void evaluate_anisotropic(const AnisotropicTables& tables, const DirectionRows& wo, const DirectionRows& wi,
                          std::ptrdiff_t count, double* out, std::ptrdiff_t stride) {
  HWY_DYNAMIC_DISPATCH(evaluate)(tables, wo, wi, count, out, stride);
}

AnisotropicPoints anisotropic_points(const AnisotropicStructure& structure, const DirectionRows& wo,
                                     const DirectionRows& wi, std::ptrdiff_t count) {
  const int shared = shared_terms(structure), colours = colour_terms(structure);
  AnisotropicPoints points{.numbers = 3 + shared + colours};
  const std::ptrdiff_t blocks = (count + kPointBlock - 1) / kPointBlock;
  points.values.resize(static_cast<std::size_t>(blocks * points.numbers * kPointBlock));
  if (count > 0) {
    HWY_DYNAMIC_DISPATCH(find_points)(structure, wo, wi, count, shared, colours, points);
  }
  return points;
}

}  // namespace sklar::brdf
#endif
