#pragma once
/// The shader texts of brdf/code/ as they are embedded in the library.

#include <string_view>

namespace sklar::brdf::code {

/// GLSL: what evaluates an anisotropic model, what both models have in common, what evaluates a refined model of an
/// isotropic material, and what samples any of them.
[[nodiscard]] std::string_view anisotropic();
[[nodiscard]] std::string_view common();
[[nodiscard]] std::string_view refined();
[[nodiscard]] std::string_view sampling();

}  // namespace sklar::brdf::code
