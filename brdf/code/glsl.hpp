#pragma once
/// A fitted model as a piece of a GLSL shader.

#include <string>
#include <vector>

#include "brdf/code/model_code.hpp"

namespace sklar::brdf {

/// A constant array and `float sklar_value(int i)` that reads it, in GLSL 1.30 and later, ES 3.00 included.
[[nodiscard]] std::string glsl_values(const std::vector<float>& values);

/// Values and functions, to be put into a fragment, vertex or compute shader after its #version line; in GLSL ES with
/// `precision highp float; precision highp int;`. @param title of one line, goes into a comment.
[[nodiscard]] std::string to_glsl(const ModelCode& code, const std::string& title);

}  // namespace sklar::brdf
