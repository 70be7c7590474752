#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "brdf/sampling/sampler_kernel_simd.cpp"
#include "copula/instruction_sets.hpp"
//
#include <hwy/foreach_target.h>
//
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "brdf/sampling/sampler_kernel.hpp"
#include "brdf/sampling/sampler_steps-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sklar::brdf::HWY_NAMESPACE {

HWY_INLINE Vec3 cosine_draw(const Vec2& uniforms) {
  const double radius = std::sqrt(uniforms.x()), phi = 2 * std::numbers::pi * uniforms.y();
  return {radius * std::cos(phi), radius * std::sin(phi), std::sqrt(1 - uniforms.x())};
}

double pdf(const SamplerTables& tables, const Vec3& wo, const Vec3& wi) {
  if (!(wo.z() > 0 && wi.z() > 0)) return 0;
  const Nodes nodes(tables, wo.z());
  return density(nodes, Standing::of(Outgoing(wo), nodes.spread(), wo, wi), wi.z());
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
  return {wi, wi.z() > 0 ? density(nodes, Standing::of(given, nodes.spread(), wo, wi), wi.z()) : 0.0};
}

/// Rows whose draws are made together, pass by pass: within a pass the chains of all rows overlap, which those of whole
/// draws one after the other do not, and what needs no table is done for several rows at once.
class RowsOfDraws {
 public:
  static constexpr std::size_t kRows = 16;

  RowsOfDraws(const SamplerTables& tables, const DirectionsRef& wo, const UniformsRef& uniforms, Samples& out)
      : tables_(tables), wo_rows_(wo), uniforms_(uniforms), out_(out) {}

  void draw(Eigen::Index first, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) load(i, first + static_cast<Eigen::Index>(i));
    for (std::size_t i = 0; i < kRows; ++i) look(i);
    for (std::size_t i = 0; i < count; ++i) choose(i);
    for (std::size_t i = 0; i < count; ++i) place_azimuth(i);
    for (std::size_t i = 0; i < count; ++i) place_polar(i);
    for (std::size_t i = 0; i < kRows; ++i) turn(i);
    for (std::size_t i = 0; i < kRows; ++i) stand(i);
    for (std::size_t i = 0; i < count; ++i) store(i, first + static_cast<Eigen::Index>(i));
  }

 private:
  using Column = std::array<double, kRows>;

  [[nodiscard]] HWY_INLINE Outgoing given(std::size_t i) const {
    Outgoing result;
    result.sine = sine_[i];
    result.cosine = cosine_[i];
    result.along = Vec2(along_x_[i], along_y_[i]);
    return result;
  }
  [[nodiscard]] HWY_INLINE Vec3 wo(std::size_t i) const { return {wo_x_[i], wo_y_[i], wo_z_[i]}; }
  [[nodiscard]] HWY_INLINE Vec3 wi(std::size_t i) const { return {wi_x_[i], wi_y_[i], wi_z_[i]}; }

  HWY_INLINE void load(std::size_t i, Eigen::Index row) {
    wo_x_[i] = wo_rows_(row, 0);
    wo_y_[i] = wo_rows_(row, 1);
    wo_z_[i] = wo_rows_(row, 2);
    first_[i] = uniforms_(row, 0);
    second_[i] = uniforms_(row, 1);
  }
  HWY_INLINE void look(std::size_t i) {
    const Outgoing outgoing(wo(i));
    sine_[i] = outgoing.sine;
    cosine_[i] = outgoing.cosine;
    along_x_[i] = outgoing.along.x();
    along_y_[i] = outgoing.along.y();
  }
  HWY_INLINE void choose(std::size_t i) {
    nodes_[i] = Nodes(tables_, wo_z_[i]);
    const Chosen chosen(nodes_[i], first_[i]);
    component_[i] = chosen.component;
    turned_[i] = chosen.turned;
    is_wi_[i] = chosen.is_wi();
    spread_[i] = nodes_[i].spread();
  }
  HWY_INLINE void place_azimuth(std::size_t i) {
    const Quotient azimuth = inverse(nodes_[i], kAzimuth[component_[i]], std::abs(turned_[i]));
    azimuth_part_[i] = azimuth.part;
    azimuth_whole_[i] = azimuth.whole;
  }
  HWY_INLINE void place_polar(std::size_t i) {
    const Quotient polar = inverse(nodes_[i], kPolar[component_[i]], second_[i]);
    polar_part_[i] = polar.part;
    polar_whole_[i] = polar.whole;
  }
  HWY_INLINE void turn(std::size_t i) {
    const LocalDirection local =
        direction_of<LoopChoice>(given(i), spread_[i], is_wi_[i], turned_[i], {azimuth_part_[i], azimuth_whole_[i]},
                                 {polar_part_[i], polar_whole_[i]});
    wi_x_[i] = local.along * along_x_[i] - local.across * along_y_[i];
    wi_y_[i] = local.along * along_y_[i] + local.across * along_x_[i];
    wi_z_[i] = local.up;
  }
  HWY_INLINE void stand(std::size_t i) {
    const Standing at = Standing::of(given(i), spread_[i], wo(i), wi(i));
    half_polar_[i] = at.half_polar;
    half_azimuth_[i] = at.half_azimuth;
    half_measure_[i] = at.half_measure;
    wi_polar_[i] = at.wi_polar;
    wi_azimuth_[i] = at.wi_azimuth;
    wi_measure_[i] = at.wi_measure;
  }
  HWY_INLINE void store(std::size_t i, Eigen::Index row) {
    Draw one{wi(i),
             density(nodes_[i],
                     {half_polar_[i], half_azimuth_[i], half_measure_[i], wi_polar_[i], wi_azimuth_[i], wi_measure_[i]},
                     wi_z_[i])};
    const bool ordinary = wo_z_[i] > 0 && wi_z_[i] > 0 && first_[i] >= kSamplerCosineShare;
    if (!ordinary) one = HWY_NAMESPACE::draw(tables_, wo(i), {first_[i], second_[i]});
    out_.wi.row(row) = one.wi.array().transpose();
    out_.pdf(row) = one.pdf;
  }

  const SamplerTables& tables_;
  const DirectionsRef& wo_rows_;
  const UniformsRef& uniforms_;
  Samples& out_;
  std::array<Nodes, kRows> nodes_{};
  std::array<std::size_t, kRows> component_{};
  Column wo_x_{}, wo_y_{}, wo_z_{}, first_{}, second_{};
  Column sine_{}, cosine_{}, along_x_{}, along_y_{}, spread_{}, is_wi_{}, turned_{};
  Column azimuth_part_{}, azimuth_whole_{}, polar_part_{}, polar_whole_{};
  Column wi_x_{}, wi_y_{}, wi_z_{};
  Column half_polar_{}, half_azimuth_{}, half_measure_{}, wi_polar_{}, wi_azimuth_{}, wi_measure_{};
};

void draw_rows(const SamplerTables& tables, const DirectionsRef& wo, const UniformsRef& uniforms, Samples& out) {
  RowsOfDraws block(tables, wo, uniforms, out);
  constexpr auto kRows = static_cast<Eigen::Index>(RowsOfDraws::kRows);
  for (Eigen::Index first = 0; first < wo.rows(); first += kRows) {
    block.draw(first, static_cast<std::size_t>(std::min(kRows, wo.rows() - first)));
  }
}

}  // namespace sklar::brdf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sklar::brdf {
namespace {
HWY_EXPORT(pdf);
HWY_EXPORT(direction);
HWY_EXPORT(draw);
HWY_EXPORT(draw_rows);
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

void sampler_draw_rows(const SamplerTables& tables, const DirectionsRef& wo, const UniformsRef& uniforms,
                       Samples& out) {
  HWY_DYNAMIC_DISPATCH(draw_rows)(tables, wo, uniforms, out);
}

}  // namespace sklar::brdf
#endif
