#pragma once
/// Numbers and names as text of GLSL and C++.

#include <string>
#include <string_view>

namespace sklar::brdf {

/// The shortest text that reads back as the same number, with a point or an exponent. @param value finite.
[[nodiscard]] std::string number_text(double value);
[[nodiscard]] std::string number_text(float value);

/// A line that defines a constant: `const int sklar_NAME = VALUE;`, or a float.
[[nodiscard]] std::string constant_text(std::string_view name, int value);
[[nodiscard]] std::string constant_text(std::string_view name, double value);

/// A line without its comment sign that says what a source was made from. @param material any text; what could end the
/// comment becomes a blank.
[[nodiscard]] std::string origin_text(std::string_view material);

}  // namespace sklar::brdf
