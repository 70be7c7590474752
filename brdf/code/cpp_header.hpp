#pragma once
/// A fitted model as a C++ header.

#include <string>

#include "brdf/code/model_code.hpp"

namespace sklar::brdf {

/// A header of C++17 that needs `<array>` and `<cmath>` only, allocates nothing and keeps no state. In namespace
/// cpp_namespace(material):
///
///     struct vec2 { double x, y; };  struct vec3 { double x, y, z; };
///     struct Sample { vec3 wi; double pdf; vec3 weight; };
///     vec3 eval(vec3 wo, vec3 wi);
///     double pdf(vec3 wo, vec3 wi);
///     Sample sample(vec3 wo, vec2 uniforms);
///
/// @param code of with_sampler.
[[nodiscard]] std::string to_cpp_header(const ModelCode& code, const std::string& material);

/// sklar_ and the material, with _ for what may not be in an identifier.
[[nodiscard]] std::string cpp_namespace(const std::string& material);

}  // namespace sklar::brdf
