// The steps of a draw and of its density, for the kernel of the sampler. Included once for each instruction set.

#if defined(SKLAR_BRDF_SAMPLING_SAMPLER_STEPS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKLAR_BRDF_SAMPLING_SAMPLER_STEPS_INL_H_
#undef SKLAR_BRDF_SAMPLING_SAMPLER_STEPS_INL_H_
#else
#define SKLAR_BRDF_SAMPLING_SAMPLER_STEPS_INL_H_
#endif

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
struct OneChoice {
  static HWY_INLINE double of(double positive, double then, double otherwise) {
    return (Pair{positive, 0} > 0 ? Pair{then, 0} : Pair{otherwise, 0})[0];
  }
};

/// The same for loops, which the compiler turns into vectors where it sees the condition.
struct LoopChoice {
  static HWY_INLINE double of(double positive, double then, double otherwise) {
    return positive > 0 ? then : otherwise;
  }
};

/// The two nodes around theta_o.
struct Nodes {
  Nodes() = default;
  HWY_INLINE Nodes(const SamplerTables& tables, double cosine) : Nodes(tables.nodes.data(), node(cosine), cosine) {}

  /// Entries of both at the same place, or of rows at `from` and `to`.
  template <class Lanes>
  [[nodiscard]] HWY_INLINE Lanes between(const float* from, const float* to) const {
    const Lanes a = load<Lanes>(from), b = load<Lanes>(to);
    return a + share * (b - a);
  }
  [[nodiscard]] HWY_INLINE float between(float a, float b) const { return a + share * (b - a); }
  [[nodiscard]] HWY_INLINE double spread() const { return static_cast<double>(between(low->spread, high->spread)); }

  const SamplerNode* low = nullptr;
  const SamplerNode* high = nullptr;
  float share = 0;

 private:
  HWY_INLINE Nodes(const SamplerNode* nodes, std::size_t node, double cosine)
      : low(nodes + node),
        high(nodes + node + 1),
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

/// Where wi stands in all margins, and what the products of their densities count.
struct Standing {
  double half_polar, half_azimuth, half_measure, wi_polar, wi_azimuth, wi_measure;

  /// Both above the horizon.
  static HWY_INLINE Standing of(const Outgoing& given, double spread, const Vec3& wo, const Vec3& wi) {
    const WiCoordinates at(given, wo, wi);
    const DiskWarp::Place polar = DiskWarp(spread).of(at.disk2);
    return {polar.coordinate, at.disk_azimuth, polar.slope * at.disk_measure, at.radius2, at.azimuth, at.measure};
  }
};

HWY_INLINE double density(const Nodes& nodes, const Standing& wi, double cosine) {
  const SamplerNode &low = *nodes.low, &high = *nodes.high;
  const Four half =
      densities(nodes, low.half_polar, high.half_polar, Place<kOfHalf.polar_cells>(wi.half_polar)) *
      densities(nodes, low.half_azimuth, high.half_azimuth, Place<kOfHalf.azimuth_cells>(wi.half_azimuth));
  const Two of_wi = densities(nodes, low.wi_polar, high.wi_polar, Place<kOfWi.polar_cells>(wi.wi_polar)) *
                    densities(nodes, low.wi_azimuth, high.wi_azimuth, Place<kOfWi.azimuth_cells>(wi.wi_azimuth));
  const auto sums = nodes.between<Eight>(low.shares.data(), high.shares.data());
  const Four before = __builtin_shufflevector(sums, sums, 0, 1, 2, 3);
  const Four parts = half * (__builtin_shufflevector(sums, sums, 1, 2, 3, 4) - before);
  const float sum = (parts[0] + parts[1]) + (parts[2] + parts[3]);
  const float sum_of_wi = of_wi[0] * (sums[5] - sums[4]) + of_wi[1] * (sums[6] - sums[5]);
  const double total = static_cast<double>(sum) * wi.half_measure + static_cast<double>(sum_of_wi) * wi.wi_measure;
  return (1 - kSamplerCosineShare) * total + kSamplerCosineShare * std::numbers::inv_pi * cosine;
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
  const auto* low = reinterpret_cast<const float*>(nodes.low);
  const auto* high = reinterpret_cast<const float*>(nodes.high);
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

/// The component that is drawn from, and what is left of the uniform: in [-1,1], the sign for the side of the plane of
/// incidence, the rest for the azimuth.
struct Chosen {
  std::size_t component = 0;
  double turned = 0;

  Chosen() = default;
  HWY_INLINE Chosen(const Nodes& nodes, double first_uniform) {
    const float *low = nodes.low->shares.data(), *high = nodes.high->shares.data();
    const double chance = (first_uniform - kSamplerCosineShare) * (1 / (1 - kSamplerCosineShare));
    constexpr int kLast = kSamplerComponents - 1;
    const int reached = count_reached<8>(low + 1, high + 1, nodes.share, kLast, static_cast<float>(chance));
    component = static_cast<std::size_t>(reached);
    const double from = nodes.between(low[component], high[component]);
    const double to = nodes.between(low[component + 1], high[component + 1]);
    turned = std::clamp(2 * (chance - from) / (to - from) - 1, -1.0, 1.0);
  }

  /// Positive for a component of wi.
  [[nodiscard]] HWY_INLINE double is_wi() const { return static_cast<double>(component) - (kOfHalf.components - 0.5); }
};

/// wi of the coordinates that a component has drawn, relative to the plane of incidence. @param is_wi positive where
/// they are those of wi. @param side the sign of the side of that plane.
template <class Choice>
HWY_INLINE LocalDirection direction_of(const Outgoing& given, double spread, double is_wi, double side,
                                       const Quotient& azimuth, const Quotient& polar) {
  const double whole = azimuth.whole, behind = whole - 2 * azimuth.part, tangent = whole - std::abs(behind);
  const double length = 1 / (whole * whole + tangent * tangent);
  const double cosine = std::copysign((whole * whole - tangent * tangent) * length, behind);
  const double sine = std::copysign(2 * whole * tangent * length, side);
  const double radius2 = polar.part / polar.whole;
  const double square = Choice::of(is_wi, radius2, DiskWarp(spread).disk2(polar.part, polar.whole));
  const double radius = std::sqrt(square), x = radius * cosine, y = radius * sine;
  const LocalDirection half = from_disk(given, x, y, square, 1 - square);
  return {Choice::of(is_wi, x, half.along), Choice::of(is_wi, y, half.across),
          Choice::of(is_wi, std::sqrt(1 - radius2), half.up)};
}

/// wo above the horizon.
HWY_INLINE Vec3 drawn(const Outgoing& given, const Nodes& nodes, const Vec2& uniforms) {
  const Chosen chosen(nodes, uniforms.x());
  const Quotient azimuth = inverse(nodes, kAzimuth[chosen.component], std::abs(chosen.turned));
  const Quotient polar = inverse(nodes, kPolar[chosen.component], uniforms.y());
  const LocalDirection local =
      direction_of<OneChoice>(given, nodes.spread(), chosen.is_wi(), chosen.turned, azimuth, polar);
  // x and y in one store: a copy of the vector loads both at once, and waits until two stores have left the pipeline.
  // And as sums of vectors: from the same in numbers GCC 12 makes one vfmaddsub, whatever -ffp-contract says.
  const double cos_o = given.along.x(), sin_o = given.along.y();
  const Pair level =
      Pair{local.along, local.along} * Pair{cos_o, sin_o} + Pair{-local.across, local.across} * Pair{sin_o, cos_o};
  Vec3 wi;
  std::memcpy(wi.data(), &level, sizeof level);
  wi.z() = local.up;
  return wi;
}

}  // namespace sklar::brdf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
