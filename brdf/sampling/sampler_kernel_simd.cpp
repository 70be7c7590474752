#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "brdf/sampling/sampler_kernel_simd.cpp"
#include "copula/instruction_sets.hpp"
//
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <numbers>

#include "brdf/geometry/half_disk.hpp"
#include "brdf/sampling/disk_warp.hpp"
#include "brdf/sampling/sampler_kernel.hpp"

// All that takes or returns vectors here is inlined: no call depends on how they are passed.
#pragma GCC diagnostic ignored "-Wpsabi"

HWY_BEFORE_NAMESPACE();
namespace sklar::brdf::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Vectors as compilers have them: four lanes are the same code in every instruction set, also in one without vectors.
using Two = float __attribute__((vector_size(2 * sizeof(float))));
using Four = float __attribute__((vector_size(4 * sizeof(float))));
using Pair = double __attribute__((vector_size(2 * sizeof(double))));
using Eight = float __attribute__((vector_size(8 * sizeof(float))));
static_assert(kOfHalf.components == 4 && kOfWi.components == 2);

template <class Lanes>
HWY_INLINE Lanes load(const float* from) {
  Lanes lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}

/// What a condition selects, without a branch: those on drawn numbers would be guessed wrongly.
HWY_INLINE double choose(double positive, double then, double otherwise) {
  return (Pair{positive, 0} > 0 ? Pair{then, 0} : Pair{otherwise, 0})[0];
}

/// The two nodes around theta_o.
struct Nodes {
  HWY_INLINE Nodes(const SamplerTables& tables, double cosine) : Nodes(tables.nodes.data(), node(cosine), cosine) {}

  /// Entries of both at the same place, or of rows at `from` and `to`.
  template <class Lanes>
  [[nodiscard]] HWY_INLINE Lanes between(const float* from, const float* to) const {
    const Lanes a = load<Lanes>(from), b = load<Lanes>(to);
    return a + share * (b - a);
  }
  [[nodiscard]] HWY_INLINE float between(float a, float b) const { return a + share * (b - a); }
  [[nodiscard]] HWY_INLINE double spread() const { return static_cast<double>(between(low.spread, high.spread)); }

  const SamplerNode& low;
  const SamplerNode& high;
  float share;

 private:
  HWY_INLINE Nodes(const SamplerNode* nodes, std::size_t node, double cosine)
      : low(nodes[node]),
        high(nodes[node + 1]),
        share(std::max(kOutgoingCosines[node] - static_cast<float>(cosine), 0.0F) * kInverse[node]) {}

  /// The last node before theta_o that is not the last of all.
  HWY_INLINE static std::size_t node(double cosine) {
    const auto wanted = static_cast<float>(cosine);
    int count = 0;
    for (std::size_t i = 1; i < kIntervals; ++i) count += kOutgoingCosines[i] > wanted;
    return static_cast<std::size_t>(count);
  }

  static constexpr std::size_t kIntervals = kOutgoingNodes - 1;
  static constexpr auto kInverse = [] {
    std::array<float, kIntervals> inverse{};
    for (std::size_t i = 0; i < kIntervals; ++i) inverse[i] = 1 / (kOutgoingCosines[i] - kOutgoingCosines[i + 1]);
    return inverse;
  }();
};

/// A coordinate among the knots of its margins.
template <std::size_t Cells>
struct Place {
  std::size_t cell;
  float inside;

  HWY_INLINE explicit Place(double coordinate) {
    const double position = coordinate * static_cast<double>(Cells);
    const int index = std::min(static_cast<int>(position), static_cast<int>(Cells) - 1);
    cell = static_cast<std::size_t>(index);
    inside = static_cast<float>(position - index);
  }
};

template <std::size_t Cells>
HWY_INLINE Four densities(const Nodes& nodes, const MarginTable<4, Cells>& low, const MarginTable<4, Cells>& high,
                          const Place<Cells>& at) {
  const auto ends = nodes.between<Eight>(low.density[at.cell].data(), high.density[at.cell].data());
  const Four first = __builtin_shufflevector(ends, ends, 0, 1, 2, 3);
  return first + at.inside * (__builtin_shufflevector(ends, ends, 4, 5, 6, 7) - first);
}

template <std::size_t Cells>
HWY_INLINE Two densities(const Nodes& nodes, const MarginTable<2, Cells>& low, const MarginTable<2, Cells>& high,
                         const Place<Cells>& at) {
  const auto ends = nodes.between<Four>(low.density[at.cell].data(), high.density[at.cell].data());
  const Two first = __builtin_shufflevector(ends, ends, 0, 1);
  return first + at.inside * (__builtin_shufflevector(ends, ends, 2, 3) - first);
}

/// Both above the horizon. A function of its own, so that it rounds alike wherever it is called.
HWY_NOINLINE double density(const Outgoing& given, const Nodes& nodes, const Vec3& wo, const Vec3& wi) {
  const SamplerNode &low = nodes.low, &high = nodes.high;
  const WiCoordinates at(given, wo, wi);
  const DiskWarp::Place polar = DiskWarp(nodes.spread()).of(at.disk2);
  const Four half =
      densities(nodes, low.half_polar, high.half_polar, Place<kOfHalf.polar_cells>(polar.coordinate)) *
      densities(nodes, low.half_azimuth, high.half_azimuth, Place<kOfHalf.azimuth_cells>(at.disk_azimuth));
  const Two of_wi = densities(nodes, low.wi_polar, high.wi_polar, Place<kOfWi.polar_cells>(at.radius2)) *
                    densities(nodes, low.wi_azimuth, high.wi_azimuth, Place<kOfWi.azimuth_cells>(at.azimuth));
  const auto sums = nodes.between<Eight>(low.shares.data(), high.shares.data());
  const Four before = __builtin_shufflevector(sums, sums, 0, 1, 2, 3);
  const Four parts = half * (__builtin_shufflevector(sums, sums, 1, 2, 3, 4) - before);
  const float sum = (parts[0] + parts[1]) + (parts[2] + parts[3]);
  const float sum_of_wi = of_wi[0] * (sums[5] - sums[4]) + of_wi[1] * (sums[6] - sums[5]);
  const double total =
      static_cast<double>(sum) * (polar.slope * at.disk_measure) + static_cast<double>(sum_of_wi) * at.measure;
  return (1 - kSamplerCosineShare) * total + kSamplerCosineShare * std::numbers::inv_pi * wi.z();
}

/// Where a margin of a component is in a node, counted in floats, so that no draw takes a branch on its component.
struct MarginLayout {
  std::int32_t density, stride, cdf, cells;
};

template <std::size_t Components, std::size_t Cells>
constexpr MarginLayout layout(std::size_t offset, std::size_t component) {
  using Table = MarginTable<Components, Cells>;
  const std::size_t density = (offset + offsetof(Table, density)) / sizeof(float) + component;
  const std::size_t cdf = (offset + offsetof(Table, cdf)) / sizeof(float) + component * Cells;
  return {static_cast<std::int32_t>(density), std::int32_t{Components}, static_cast<std::int32_t>(cdf),
          std::int32_t{Cells}};
}

template <std::size_t HalfCells, std::size_t WiCells>
constexpr std::array<MarginLayout, kSamplerComponents> layouts(std::size_t half, std::size_t wi) {
  std::array<MarginLayout, kSamplerComponents> result{};
  for (std::size_t k = 0; k < kOfHalf.components; ++k) result[k] = layout<kOfHalf.components, HalfCells>(half, k);
  for (std::size_t k = 0; k < kOfWi.components; ++k) {
    result[kOfHalf.components + k] = layout<kOfWi.components, WiCells>(wi, k);
  }
  return result;
}

constexpr auto kPolar =
    layouts<kOfHalf.polar_cells, kOfWi.polar_cells>(offsetof(SamplerNode, half_polar), offsetof(SamplerNode, wi_polar));
constexpr auto kAzimuth = layouts<kOfHalf.azimuth_cells, kOfWi.azimuth_cells>(offsetof(SamplerNode, half_azimuth),
                                                                              offsetof(SamplerNode, wi_azimuth));

/// What the search may read of a row, its end included, stays within the node.
constexpr std::size_t kSearched = 16;
static_assert(kOfHalf.polar_cells <= kSearched);
static_assert(kAzimuth.back().cdf + kSearched <= sizeof(SamplerNode) / sizeof(float));

/// How many of the first `cells` entries of a row are at most `level`. @tparam Searched how many are read.
template <std::size_t Searched>
HWY_INLINE int count_reached(const float* low, const float* high, float share, int cells, float level) {
  const hn::CappedTag<float, Searched> d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  std::size_t count = 0;
  for (int i = 0; i < static_cast<int>(Searched); i += lanes) {
    const auto from = hn::LoadU(d, low + i);
    const auto entry = hn::MulAdd(hn::Set(d, share), hn::Sub(hn::LoadU(d, high + i), from), from);
    const auto counted = hn::FirstN(d, static_cast<std::size_t>(std::max(cells - i, 0)));
    count += hn::CountTrue(d, hn::And(hn::Le(entry, hn::Set(d, level)), counted));
  }
  return static_cast<int>(count);
}

/// A drawn coordinate, part / whole: a quotient, so that what follows needs one division for both.
struct Quotient {
  double part, whole;
};

/// The coordinate at which the cdf of a margin is `level`.
HWY_INLINE Quotient inverse(const Nodes& nodes, const MarginLayout& margin, double level) {
  const auto* low = reinterpret_cast<const float*>(&nodes.low);
  const auto* high = reinterpret_cast<const float*>(&nodes.high);
  const float *low_cdf = low + margin.cdf, *high_cdf = high + margin.cdf;
  const int reached = count_reached<kSearched>(low_cdf, high_cdf, nodes.share, margin.cells, static_cast<float>(level));
  const int cell = std::min(reached, margin.cells - 1), entry = margin.density + cell * margin.stride;
  const double first = nodes.between(low[entry], high[entry]);
  const double last = nodes.between(low[entry + margin.stride], high[entry + margin.stride]);
  const double upper = nodes.between(low_cdf[cell], high_cdf[cell]);
  const double mass = std::max((level - upper) * margin.cells + 0.5 * (first + last), 0.0);
  const double root = first + std::sqrt(std::max(first * first + 2 * (last - first) * mass, 0.0));
  return {cell * root + std::min(2 * mass, root), margin.cells * root};
}

/// wo above the horizon.
HWY_INLINE Vec3 drawn(const Outgoing& given, const Nodes& nodes, const Vec2& uniforms) {
  const float *low = nodes.low.shares.data(), *high = nodes.high.shares.data();
  const double chance = (uniforms.x() - kSamplerCosineShare) * (1 / (1 - kSamplerCosineShare));
  constexpr int kLast = kSamplerComponents - 1;
  const int reached = count_reached<8>(low + 1, high + 1, nodes.share, kLast, static_cast<float>(chance));
  const auto k = static_cast<std::size_t>(reached);
  const double from = nodes.between(low[k], high[k]), to = nodes.between(low[k + 1], high[k + 1]);
  const double turned = std::clamp(2 * (chance - from) / (to - from) - 1, -1.0, 1.0);
  const Quotient azimuth = inverse(nodes, kAzimuth[k], std::abs(turned));
  const Quotient polar = inverse(nodes, kPolar[k], uniforms.y());

  const double whole = azimuth.whole, behind = whole - 2 * azimuth.part, tangent = whole - std::abs(behind);
  const double length = 1 / (whole * whole + tangent * tangent);
  const double cosine = std::copysign((whole * whole - tangent * tangent) * length, behind);
  const double sine = std::copysign(2 * whole * tangent * length, turned);
  const double radius2 = polar.part / polar.whole, is_wi = static_cast<double>(k) - (kOfHalf.components - 0.5);
  const double square = choose(is_wi, radius2, DiskWarp(nodes.spread()).disk2(polar.part, polar.whole));
  const double radius = std::sqrt(square), x = radius * cosine, y = radius * sine;
  const LocalDirection half = from_disk(given, x, y, square, 1 - square);
  const double along = choose(is_wi, x, half.along), across = choose(is_wi, y, half.across);
  const double up = choose(is_wi, std::sqrt(1 - radius2), half.up);
  // x and y in one store: a copy of the vector loads both at once, and waits until two stores have left the pipeline.
  const Pair level{along * given.along.x() - across * given.along.y(),
                   along * given.along.y() + across * given.along.x()};
  Vec3 wi;
  std::memcpy(wi.data(), &level, sizeof level);
  wi.z() = up;
  return wi;
}

HWY_INLINE Vec3 cosine_draw(const Vec2& uniforms) {
  const double radius = std::sqrt(uniforms.x()), phi = 2 * std::numbers::pi * uniforms.y();
  return {radius * std::cos(phi), radius * std::sin(phi), std::sqrt(1 - uniforms.x())};
}

double pdf(const SamplerTables& tables, const Vec3& wo, const Vec3& wi) {
  if (!(wo.z() > 0 && wi.z() > 0)) return 0;
  return density(Outgoing(wo), Nodes(tables, wo.z()), wo, wi);
}

Vec3 direction(const SamplerTables& tables, const Vec3& wo, const Vec2& uniforms) {
  if (!(wo.z() > 0)) return cosine_draw(uniforms);
  if (uniforms.x() < kSamplerCosineShare) return cosine_draw({uniforms.x() / kSamplerCosineShare, uniforms.y()});
  return drawn(Outgoing(wo), Nodes(tables, wo.z()), uniforms);
}

Draw draw(const SamplerTables& tables, const Vec3& wo, const Vec2& uniforms) {
  if (!(wo.z() > 0 && uniforms.x() >= kSamplerCosineShare)) {
    const Vec3 wi = direction(tables, wo, uniforms);
    return {wi, pdf(tables, wo, wi)};
  }
  const Outgoing given(wo);
  const Nodes nodes(tables, wo.z());
  const Vec3 wi = drawn(given, nodes, uniforms);
  return {wi, wi.z() > 0 ? density(given, nodes, wo, wi) : 0.0};
}

}  // namespace sklar::brdf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sklar::brdf {
namespace {
HWY_EXPORT(pdf);
HWY_EXPORT(direction);
HWY_EXPORT(draw);
}  // namespace

double sampler_pdf(const SamplerTables& tables, const Vec3& wo, const Vec3& wi) {
  return HWY_DYNAMIC_DISPATCH(pdf)(tables, wo, wi);
}

Vec3 sampler_direction(const SamplerTables& tables, const Vec3& wo, const Vec2& uniforms) {
  return HWY_DYNAMIC_DISPATCH(direction)(tables, wo, uniforms);
}

Draw sampler_draw(const SamplerTables& tables, const Vec3& wo, const Vec2& uniforms) {
  return HWY_DYNAMIC_DISPATCH(draw)(tables, wo, uniforms);
}

}  // namespace sklar::brdf
#endif
