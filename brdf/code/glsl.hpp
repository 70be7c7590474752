#pragma once
/// A fitted model as a piece of a GLSL shader, and as one that BRDF Explorer loads.

#include <string>
#include <vector>

#include "brdf/code/model_code.hpp"

namespace sklar::brdf {

/// A constant array and `float sklar_value(int i)` that reads it, in GLSL 1.30 and later, ES 3.00 included.
[[nodiscard]] std::string glsl_values(const std::vector<float>& values);

/// Values and functions, to be put into a fragment, vertex or compute shader after its `#version` line; in GLSL ES with
/// `precision highp float; precision highp int;`. @param material named in a comment.
[[nodiscard]] std::string to_glsl(const ModelCode& code, const std::string& material);

/// A `.brdf` file of BRDF Explorer, without parameters. @param code of evaluation_code.
[[nodiscard]] std::string to_brdf_explorer(const ModelCode& code, const std::string& material);

}  // namespace sklar::brdf
