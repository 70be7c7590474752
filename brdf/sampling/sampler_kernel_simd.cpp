#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "brdf/sampling/sampler_kernel_simd.cpp"
#include "copula/instruction_sets.hpp"
//
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>

#include "brdf/sampling/sampler_copula.hpp"
#include "brdf/sampling/sampler_kernel.hpp"
#include "brdf/sampling/wi_coordinates.hpp"

HWY_BEFORE_NAMESPACE();
namespace sklar::brdf::HWY_NAMESPACE {

// Vectors as compilers have them: four lanes are the same code in every instruction set, also in one without vectors.
using V = float __attribute__((vector_size(4 * sizeof(float))));
using Ints = std::int32_t __attribute__((vector_size(4 * sizeof(std::int32_t))));
using Doubles = double __attribute__((vector_size(4 * sizeof(double))));
using Eight = float __attribute__((vector_size(8 * sizeof(float))));
static_assert(sizeof(V) == kSamplerComponents * sizeof(float));

HWY_INLINE V load(const float* from) {
  V v;
  std::memcpy(&v, from, sizeof v);
  return v;
}

HWY_INLINE V between(V low, V high, float share) {
  return low + share * (high - low);
}

/// Component 0 of one, the others of another.
HWY_INLINE V first_and_others(V first, V others) {
  return __builtin_shufflevector(first, others, 0, 5, 6, 7);
}

HWY_INLINE V first_and_others(double first, double others) {
  const auto a = static_cast<float>(first), b = static_cast<float>(others);
  return V{a, b, b, b};
}

/// What a condition selects, without a branch: those on drawn numbers would be guessed wrongly.
HWY_INLINE double choose(double positive, double then, double otherwise) {
  using Pair = double __attribute__((vector_size(2 * sizeof(double))));
  return (Pair{positive, 0} > 0 ? Pair{then, 0} : Pair{otherwise, 0})[0];
}

/// FoldedAzimuth::of.
HWY_INLINE FoldedAzimuth folded_azimuth(double x, double y, double length) {
  constexpr double kTiny = 1e-300;
  const double tangent = std::abs(y) / (length + std::abs(x) + kTiny);
  return {0.5 - std::copysign(0.5 - 0.5 * tangent, x), 0.25 + 0.25 * tangent * tangent};
}

/// The two nodes around theta_o.
struct Nodes {
  HWY_INLINE Nodes(const SamplerTables& tables, const OutgoingPlace& place)
      : low(tables.nodes[static_cast<std::size_t>(place.node)]),
        high(tables.nodes[static_cast<std::size_t>(place.node) + 1]),
        share(place.share) {}

  HWY_INLINE V shares() const { return between(load(low.share.data()), load(high.share.data()), share); }
  HWY_INLINE V dependences() const { return between(load(low.dependence.data()), load(high.dependence.data()), share); }

  const SamplerNode& low;
  const SamplerNode& high;
  float share;
};

/// A margin of one component at a theta_o.
template <std::size_t Knots>
struct Margin {
  static constexpr int kCells = static_cast<int>(Knots) - 1;

  const MarginRow<Knots>& low;
  const MarginRow<Knots>& high;
  float share;

  /// Density and cdf at the lower end of a cell, density and cdf at the upper.
  HWY_INLINE V ends(int cell) const {
    const std::ptrdiff_t first = 2 * std::ptrdiff_t{cell};
    return between(load(low.data() + first), load(high.data() + first), share);
  }

  /// The cell in which the cdf reaches a level: as many knots as have less, but for the first.
  HWY_INLINE int cell_of(float level) const {
    constexpr std::size_t kFirst = Knots % 2 == 0 ? 0 : 2;  // so that vectors fill what is left
    static_assert((2 * Knots - kFirst) % 8 == 0);
    decltype(Eight{} <= Eight{}) less{};
    for (std::size_t i = kFirst; i < 2 * Knots; i += 8) {
      Eight here, next;
      std::memcpy(&here, low.data() + i, sizeof here);
      std::memcpy(&next, high.data() + i, sizeof next);
      less += here + share * (next - here) <= level;
    }
    const int count = -(less[1] + less[3] + less[5] + less[7]);
    return std::clamp(count - (kFirst == 0 ? 1 : 0), 0, kCells - 1);
  }

  /// The coordinate in [0,1] at which the cdf is `level`.
  HWY_INLINE double inverse(double level) const {
    const int cell = cell_of(static_cast<float>(level));
    const V e = ends(cell);
    const double first = e[0], rise = e[2] - e[0];
    const double mass = std::max(level - static_cast<double>(e[1]), 0.0) * kCells;
    const double inside = 2 * mass / (first + std::sqrt(std::max(first * first + 2 * rise * mass, 0.0)));
    return (cell + std::min(inside, 1.0)) * (1.0 / kCells);
  }

  HWY_INLINE double cdf(double coordinate) const {
    const double position = coordinate * kCells;
    const int cell = std::min(static_cast<int>(position), kCells - 1);
    const auto inside = static_cast<float>(position - cell);
    const V e = ends(cell);
    return e[1] + inside * (e[0] + 0.5F * inside * (e[2] - e[0])) * (1.0F / kCells);
  }
};

struct Margins {
  V density, cdf;
};

/// The margins of all components, each at its coordinate.
template <std::size_t Knots>
HWY_INLINE Margins margins_at(const std::array<MarginRow<Knots>, kSamplerComponents>& low,
                              const std::array<MarginRow<Knots>, kSamplerComponents>& high, float share, V coordinate) {
  constexpr int kCells = static_cast<int>(Knots) - 1;
  const V position = coordinate * float{kCells};
  Ints cell = __builtin_convertvector(position, Ints);
  cell = cell < kCells ? cell : Ints{} + (kCells - 1);
  const V inside = position - __builtin_convertvector(cell, V);
  const auto ends = [&](std::size_t k) HWY_ATTR { return Margin<Knots>{low[k], high[k], share}.ends(cell[k]); };
  const V a = ends(0), b = ends(1), c = ends(2), d = ends(3);
  const V lower = __builtin_shufflevector(a, b, 0, 4, 1, 5), lower2 = __builtin_shufflevector(c, d, 0, 4, 1, 5);
  const V upper = __builtin_shufflevector(a, b, 2, 6, 3, 7), upper2 = __builtin_shufflevector(c, d, 2, 6, 3, 7);
  const V first = __builtin_shufflevector(lower, lower2, 0, 1, 4, 5);
  const V below = __builtin_shufflevector(lower, lower2, 2, 3, 6, 7);
  const V rise = inside * (__builtin_shufflevector(upper, upper2, 0, 1, 4, 5) - first);
  return {first + rise, below + inside * (first + 0.5F * rise) * (1.0F / kCells)};
}

/// Where wi meets the horizon: slope2_most = numerator / other, so that the polar coordinate of the components is
/// numerator / (numerator + width^2 other).
struct Horizon {
  double numerator, other;

  /// @param length, x of a vector along h in the plane of the surface, x in that of incidence.
  HWY_INLINE Horizon(const Outgoing& given, double length, double x) {
    constexpr double kLeast = 1e-12;  // see Outgoing::slope2_most
    constexpr double kTiny = 1e-100;
    const double a = std::max(given.cosine, kLeast) * (length + kTiny), b = -given.sine * x;
    const double sum = std::sqrt(a * a + b * b) + std::abs(b);
    const double n = choose(b, a, sum), d = choose(b, sum, a);
    numerator = n * n;
    other = d * d;
  }
};

/// sampler_copula::truncated_density of all components.
HWY_INLINE V truncated_density(V theta, V rest, V top, V z) {
  const V rest_top = 1.0F - top, product = rest * z, scaled = theta * product;
  const V d = 1.0F - scaled, d_top = 1.0F - theta * rest_top * z;
  const V height = 1.0F + theta * (1.0F - 2.0F * (rest + z) + product + scaled);
  return height * (d_top * d_top) / (d * d * d * (top * (1.0F - theta * rest_top)));
}

/// Both above the horizon. A function of its own, so that it rounds alike wherever it is called.
HWY_NOINLINE double density(const SamplerTables& tables, const Outgoing& given, const Nodes& nodes, const Vec3& wo,
                            const Vec3& wi) {
  const double sum_x = wi.x() + wo.x(), sum_y = wi.y() + wo.y(), sum_z = wi.z() + wo.z();
  const double across2 = sum_x * sum_x + sum_y * sum_y, across = std::sqrt(across2);
  const double x = sum_x * given.along.x() + sum_y * given.along.y();
  const double y = sum_y * given.along.x() - sum_x * given.along.y();
  const FoldedAzimuth of_half = folded_azimuth(x, y, across);
  const Horizon horizon(given, across, x);
  const double radius2 = wi.x() * wi.x() + wi.y() * wi.y();
  const double wi_x = wi.x() * given.along.x() + wi.y() * given.along.y();
  const double wi_y = wi.y() * given.along.x() - wi.x() * given.along.y();
  const FoldedAzimuth of_wi = folded_azimuth(wi_x, wi_y, std::sqrt(radius2));

  const double sum_z2 = sum_z * sum_z, wi_z2 = wi.z() * wi.z();
  Doubles width2;
  std::memcpy(&width2, tables.width2.data(), sizeof width2);
  const Doubles numerator{radius2, across2, across2, across2};
  const Doubles q = 1.0 / (numerator + width2 * Doubles{wi_z2, sum_z2, sum_z2, sum_z2});
  const V polar = __builtin_convertvector(numerator * q, V);
  const V most = __builtin_convertvector(horizon.numerator / (horizon.numerator + width2 * horizon.other), V);
  const double half_factor = 0.5 * sum_z * (across2 + sum_z2) * of_half.slope;
  const Doubles measure = q * q * width2 * Doubles{wi.z() * of_wi.slope, half_factor, half_factor, half_factor};
  const Margins u = margins_at<kPolarKnots>(nodes.low.polar, nodes.high.polar, nodes.share, polar);
  const Margins v = margins_at<kAzimuthKnots>(nodes.low.azimuth, nodes.high.azimuth, nodes.share,
                                              first_and_others(of_wi.s, of_half.s));
  const V beyond = margins_at<kPolarKnots>(nodes.low.polar, nodes.high.polar, nodes.share, most).cdf;
  const V top = first_and_others(V{} + 1.0F, beyond), z = first_and_others(1.0F - v.cdf, v.cdf);
  const V coupled = truncated_density(nodes.dependences(), 1.0F - u.cdf, top, z);
  const V height = nodes.shares() * u.density * v.density * coupled;
  const Doubles part = __builtin_convertvector(height, Doubles) * measure;
  const double sum = (part[0] + part[1]) + (part[2] + part[3]);
  return (1 - kSamplerCosineShare) * sum + kSamplerCosineShare * std::numbers::inv_pi * wi.z();
}

/// What a component is made of at a theta_o, and the uniform numbers left to draw from it.
struct Component {
  Margin<kPolarKnots> polar;
  Margin<kAzimuthKnots> azimuth;
  double theta;   ///< dependence
  double p;       ///< of the polar coordinate
  double turned;  ///< of the azimuth: its cdf, negative on the other side of the plane of incidence

  HWY_INLINE Component(const Nodes& nodes, std::size_t k, double chance, double turn)
      : polar{nodes.low.polar[k], nodes.high.polar[k], nodes.share},
        azimuth{nodes.low.azimuth[k], nodes.high.azimuth[k], nodes.share},
        theta(nodes.low.dependence[k] + nodes.share * (nodes.high.dependence[k] - nodes.low.dependence[k])),
        p(std::min(chance, 1.0)),
        turned(2 * turn - 1) {}

  /// The azimuth, as a vector that is not normalised.
  struct Azimuth {
    double x, side;  ///< along the plane of incidence and across
    double length;

    HWY_INLINE Azimuth(double s, double turned) {
      const double rest = 1 - 2 * s, tangent = 1 - std::abs(rest);
      x = std::copysign(1 - tangent * tangent, rest);
      side = std::copysign(2 * tangent, turned);
      length = 1 + tangent * tangent;
    }

    HWY_INLINE Vec2 in_surface(const Outgoing& given) const {
      const double scale = 1 / length, a = x * scale, b = side * scale;
      return {a * given.along.x() - b * given.along.y(), a * given.along.y() + b * given.along.x()};
    }
  };
  HWY_INLINE Azimuth draw_azimuth() const { return {azimuth.inverse(std::abs(turned)), turned}; }
};

/// A draw of component 0, which is over wi itself.
HWY_INLINE Vec3 drawn_wi(const Component& of, const Outgoing& given) {
  const Vec2 across = of.draw_azimuth().in_surface(given);
  const double radius2 = of.polar.inverse(sampler_copula::conditional_inverse(of.theta, 1 - std::abs(of.turned), of.p));
  const double radius = std::sqrt(radius2);
  return {radius * across.x(), radius * across.y(), std::sqrt(1 - radius2)};
}

/// A draw of another, over the half vector.
HWY_INLINE Vec3 drawn_half(const Component& of, double width2, const Outgoing& given, const Vec3& wo) {
  const Component::Azimuth azimuth = of.draw_azimuth();
  const Horizon horizon(given, azimuth.length, azimuth.x);
  const double other = width2 * horizon.other, scale = 1 / (horizon.numerator + other);
  const double top = of.polar.cdf(horizon.numerator * scale);
  const double u = sampler_copula::truncated_inverse(of.theta, top, std::abs(of.turned), of.p);
  const double x = of.polar.inverse(u);
  // The half vector, not normalised: no higher slope than where wi meets the horizon.
  const double along2 = width2 * x, up2 = std::max(1 - x, other * scale);
  const double along = std::sqrt(along2), up = std::sqrt(up2);
  const Vec2 across = azimuth.in_surface(given);
  const double half_x = along * across.x(), half_y = along * across.y();
  const double factor = 2 * (wo.x() * half_x + wo.y() * half_y + wo.z() * up) * (1 / (along2 + up2));
  return {factor * half_x - wo.x(), factor * half_y - wo.y(), factor * up - wo.z()};
}

/// wo above the horizon.
HWY_INLINE Vec3 drawn(const SamplerTables& tables, const Outgoing& given, const Nodes& nodes, const Vec3& wo,
                      const Vec2& uniforms) {
  const V share = nodes.shares();
  const double chance = (uniforms.x() - kSamplerCosineShare) * (1 / (1 - kSamplerCosineShare));
  const double first = share[0], second = first + share[1], third = second + share[2];
  if (chance < first) return drawn_wi(Component(nodes, 0, chance / first, uniforms.y()), given);
  const double below[] = {first, second, third};
  const std::size_t next = (chance >= second ? 1U : 0U) + (chance >= third ? 1U : 0U), k = next + 1;
  const Component component(nodes, k, (chance - below[next]) / share[k], uniforms.y());
  return drawn_half(component, tables.width2[k], given, wo);
}

HWY_INLINE Vec3 cosine_draw(const Vec2& uniforms) {
  const double radius = std::sqrt(uniforms.x()), phi = 2 * std::numbers::pi * uniforms.y();
  return {radius * std::cos(phi), radius * std::sin(phi), std::sqrt(1 - uniforms.x())};
}

double pdf(const SamplerTables& tables, const Vec3& wo, const Vec3& wi) {
  if (!(wo.z() > 0 && wi.z() > 0)) return 0;
  return density(tables, Outgoing(wo), Nodes(tables, OutgoingPlace(wo.z())), wo, wi);
}

Vec3 direction(const SamplerTables& tables, const Vec3& wo, const Vec2& uniforms) {
  if (!(wo.z() > 0)) return cosine_draw(uniforms);
  if (uniforms.x() < kSamplerCosineShare) return cosine_draw({uniforms.x() / kSamplerCosineShare, uniforms.y()});
  return drawn(tables, Outgoing(wo), Nodes(tables, OutgoingPlace(wo.z())), wo, uniforms);
}

SamplerDraw draw(const SamplerTables& tables, const Vec3& wo, const Vec2& uniforms) {
  if (!(wo.z() > 0 && uniforms.x() >= kSamplerCosineShare)) {
    const Vec3 wi = direction(tables, wo, uniforms);
    return {wi, pdf(tables, wo, wi)};
  }
  const Outgoing given(wo);
  const Nodes nodes(tables, OutgoingPlace(wo.z()));
  const Vec3 wi = drawn(tables, given, nodes, wo, uniforms);
  return {wi, wi.z() > 0 ? density(tables, given, nodes, wo, wi) : 0.0};
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

SamplerDraw sampler_draw(const SamplerTables& tables, const Vec3& wo, const Vec2& uniforms) {
  return HWY_DYNAMIC_DISPATCH(draw)(tables, wo, uniforms);
}

}  // namespace sklar::brdf
#endif
