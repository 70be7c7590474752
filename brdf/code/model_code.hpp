#pragma once
/// A fitted model as shader text and the numbers that it reads.

#include <string>
#include <vector>

#include "brdf/model/refined_brdf.hpp"
#include "brdf/sampling/conditional_sampler.hpp"

namespace sklar::brdf {

/// Functions in GLSL (1.30 and later, ES 3.00) without preprocessor lines, all names beginning with sklar_. What reads
/// the numbers is left to the user, who puts a function
///
///     float sklar_value(int i);  // values[i], 0 <= i < values.size()
///
/// before the text: one that reads an array (see glsl.hpp) or a texture.
struct ModelCode {
  std::string text;
  std::vector<float> values;
};

/// `vec3 sklar_eval(vec3 wo, vec3 wi)`: f_r in 1/sr, red green blue, as RefinedBrdf::eval; 0 where a direction is not
/// above the horizon. Directions are unit, in the frame of the surface. Within a relative 1e-6 of RefinedBrdf::at where
/// the functions compute in double, within 2e-5 in single precision, for directions exact in it.
[[nodiscard]] ModelCode evaluation_code(const RefinedBrdf& model);

/// The same and, with the tables of a sampler of the model,
/// `float sklar_pdf(vec3 wo, vec3 wi)`: per solid angle of wi, as ConditionalSampler::pdf within a relative 2e-5 where
/// the functions compute in double;
/// `sklar_Sample sklar_sample(vec3 wo, vec2 uniforms)`: a draw of wi with its pdf and its weight f_r cos(theta_i) /
/// pdf, `struct sklar_Sample { vec3 wi; float pdf; vec3 weight; }`.
[[nodiscard]] ModelCode sampling_code(const RefinedBrdf& model, const ConditionalSampler& sampler);

}  // namespace sklar::brdf
