#pragma once
/// How well samplers follow one reflectance.

#include <array>
#include <span>
#include <string>
#include <vector>

#include "brdf/brdf.hpp"

namespace sklar::brdf {

inline constexpr std::array<double, 6> kEfficiencyAngles = {5, 20, 45, 60, 75, 80};  ///< theta_o, degrees

/// Relative standard deviation of one sample's weight in a white furnace: of the luminance of f_r cos(theta_i) / pdf.
struct SamplerEfficiency {
  std::string material, sampler;
  std::array<double, kEfficiencyAngles.size()> deviation{};  ///< at kEfficiencyAngles; inf where pdf misses light
};

/// By quadrature, so that a rare large weight counts in full. @param theta_o radians. NaN for a black reflectance.
/// @throws std::domain_error as hemisphere_nodes.
[[nodiscard]] double weight_deviation(const Brdf& sampled, double theta_o);

/// The sampler `ggx` below, to draw by: its f_r means nothing. @throws std::invalid_argument for an anisotropic brdf.
[[nodiscard]] BrdfPtr ggx_sampler(const Brdf& brdf);

/// The samplers `conditional` (SampledBrdf), `cosine`, `ggx` (GGX and cosine mixed, roughness and share those of the
/// least mean variance over the angles), `paper` (PaperSampledBrdf with Frank's copula, as printed), `paper-cosine`
/// (the cosine in its target), and `paper-eq24`: the weights of Eq. 24 for the same draws as `paper`, whose mean is the
/// albedo of the copula and not of the material. @throws std::invalid_argument for an anisotropic reflectance.
[[nodiscard]] std::vector<SamplerEfficiency> sampling_efficiency(const std::string& material, const BrdfPtr& brdf);

/// material,sampler,theta_5,..; and the same as a Markdown table.
[[nodiscard]] std::string efficiency_csv(std::span<const SamplerEfficiency> rows);
[[nodiscard]] std::string efficiency_markdown(std::span<const SamplerEfficiency> rows);

}  // namespace sklar::brdf
