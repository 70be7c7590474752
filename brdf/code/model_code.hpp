#pragma once
/// A fitted model as shader text and the numbers that it reads.

#include <string>
#include <vector>

#include "brdf/model/anisotropic_model.hpp"
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

/// `vec3 sklar_eval(vec3 wo, vec3 wi)`: f_r in 1/sr, red green blue, as the model's eval; 0 where a direction is not
/// above the horizon. Directions are unit, in the frame of the surface. Of a RefinedBrdf within a relative 1e-6 of its
/// at where the functions compute in double, within 2e-5 in single precision, for directions exact in it; of an
/// AnisotropicModel, which computes in single precision itself, within 1e-5 and 3e-5 of its eval.
[[nodiscard]] ModelCode evaluation_code(const RefinedBrdf& model);
[[nodiscard]] ModelCode evaluation_code(const AnisotropicModel& model);

/// Adds the tables of a sampler of the model, and
/// `float sklar_pdf(vec3 wo, vec3 wi)`: per solid angle of wi, as ConditionalSampler::pdf within a relative 2e-5 where
/// the functions compute in double;
/// `sklar_Sample sklar_sample(vec3 wo, vec2 uniforms)`: a draw of wi with its pdf and its weight f_r cos(theta_i) /
/// pdf, `struct sklar_Sample { vec3 wi; float pdf; vec3 weight; }`.
/// @param code of evaluation_code.
[[nodiscard]] ModelCode with_sampler(ModelCode code, const ConditionalSampler& sampler);

}  // namespace sklar::brdf
