#pragma once
/// The vector kernel of a ConditionalSampler, in the widest instruction set of the machine: the components side by side
/// in single precision, directions in double.

#include "brdf/brdf.hpp"
#include "brdf/sampling/sampler_tables.hpp"

namespace sklar::brdf {

/// The share of the draws that follow the cosine, whatever the tables.
inline constexpr double kSamplerCosineShare = 0.002;

/// See ConditionalSampler::pdf.
[[nodiscard]] double sampler_pdf(const SamplerTables& tables, const Vec3& wo, const Vec3& wi);

/// See ConditionalSampler::sample_direction.
[[nodiscard]] Vec3 sampler_direction(const SamplerTables& tables, const Vec3& wo, const Vec2& uniforms);

/// The direction of sampler_direction and what sampler_pdf gives for it, to the last bit of both.
[[nodiscard]] Draw sampler_draw(const SamplerTables& tables, const Vec3& wo, const Vec2& uniforms);

/// sampler_draw row by row, the same numbers to the last bit, in less time.
void sampler_draw_rows(const SamplerTables& tables, const DirectionsRef& wo, const UniformsRef& uniforms, Samples& out);

}  // namespace sklar::brdf
