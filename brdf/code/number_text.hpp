#pragma once
/// Numbers as text of GLSL and C++.

#include <string>
#include <string_view>

namespace sklar::brdf {

/// The shortest text that reads back as the same number, with a point or an exponent. @param value finite.
[[nodiscard]] std::string number_text(double value);
[[nodiscard]] std::string number_text(float value);

/// A line that defines a constant: `const int sklar_NAME = VALUE;`, or a float.
[[nodiscard]] std::string constant_text(std::string_view name, int value);
[[nodiscard]] std::string constant_text(std::string_view name, double value);

}  // namespace sklar::brdf
