#include "brdf/code/cpp_header.hpp"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <string_view>

#include "brdf/code/source_text.hpp"

namespace sklar::brdf {
namespace {

/// The part of GLSL that the text of a model needs.
constexpr const char* kPrelude = R"(struct vec2 {
  double x, y;
  constexpr vec2(double x_ = 0, double y_ = 0) : x(x_), y(y_) {}
};
struct vec3 {
  double x, y, z;
  constexpr vec3(double x_ = 0, double y_ = 0, double z_ = 0) : x(x_), y(y_), z(z_) {}
};
struct vec4 {
  double x, y, z, w;
  constexpr vec4(double x_ = 0, double y_ = 0, double z_ = 0, double w_ = 0) : x(x_), y(y_), z(z_), w(w_) {}
};

namespace detail {

using std::abs;
using std::cos;
using std::exp;
using std::sin;
using std::sqrt;

inline vec3 operator+(vec3 a, vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline vec3 operator-(vec3 a, vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline vec3& operator+=(vec3& a, vec3 b) { return a = a + b; }
inline vec3 operator*(double a, vec3 b) { return {a * b.x, a * b.y, a * b.z}; }
inline vec4 operator/(vec4 a, double b) { return {a.x / b, a.y / b, a.z / b, a.w / b}; }
inline double dot(vec3 a, vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline double dot(vec4 a, vec4 b) { return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w; }
inline double min(double a, double b) { return a < b ? a : b; }
inline double max(double a, double b) { return a > b ? a : b; }  // b where a is NaN: no index is made of one
inline double clamp(double x, double low, double high) { return min(max(x, low), high); }
inline double mix(double a, double b, double share) { return a + share * (b - a); }

)";

std::string values_text(const std::vector<float>& values) {
  constexpr std::size_t kRow = 8;
  std::string text = "inline constexpr std::array<float, " + std::to_string(values.size()) + "> sklar_values = {\n";
  for (std::size_t i = 0; i < values.size(); ++i) {
    text += number_text(values[i]) + (i % kRow + 1 < kRow ? "F," : "F,\n");
  }
  return text + "};\n\ninline double sklar_value(int i) { return double(sklar_values[std::size_t(i)]); }\n\n";
}

/// What the header gives to its users.
constexpr const char* kCalls = R"(}  // namespace detail

/// f_r in 1/sr, red green blue. wo, wi: unit, in the frame of the surface (z = normal), both pointing away from it; 0
/// where either is not above the horizon.
inline vec3 eval(vec3 wo, vec3 wi) { return detail::sklar_eval(wo, wi); }

/// Density of the draws of sample per solid angle of wi; 0 where either is not above the horizon.
inline double pdf(vec3 wo, vec3 wi) { return detail::sklar_pdf(wo, wi); }

/// wi, its pdf, and its weight f_r cos(theta_i) / pdf, red green blue.
using Sample = detail::sklar_Sample;

/// A draw of wi given wo. uniforms: in (0,1).
inline Sample sample(vec3 wo, vec2 uniforms) { return detail::sklar_sample(wo, uniforms); }

)";

bool in_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// A line of GLSL as C++: float is double, and a line that begins a function, the only one with a bracket and without =
/// that is not indented, begins with inline.
std::string line_as_cpp(std::string line) {
  constexpr std::string_view kFloat = "float", kDouble = "double";
  for (std::size_t at = line.find(kFloat); at != std::string::npos; at = line.find(kFloat, at + 1)) {
    const std::size_t end = at + kFloat.size();
    const bool whole = (at == 0 || !in_name(line[at - 1])) && (end == line.size() || !in_name(line[end]));
    if (whole) line.replace(at, kFloat.size(), kDouble);
  }
  const bool begins_function = !line.empty() && std::islower(static_cast<unsigned char>(line.front())) != 0 &&
                               line.find('(') != std::string::npos && line.find('=') == std::string::npos;
  return begins_function ? "inline " + line : line;
}

std::string as_cpp(const std::string& text) {
  std::istringstream lines(text);
  std::string result;
  for (std::string line; std::getline(lines, line);) result += line_as_cpp(line) + "\n";
  return result;
}

}  // namespace

std::string to_cpp_header(const ModelCode& code, const std::string& material) {
  const std::string space = "namespace " + cpp_namespace(material);
  return "// " + origin_text(material) + "#pragma once\n\n#include <array>\n#include <cmath>\n\n" + space + " {\n\n" +
         kPrelude + values_text(code.values) + as_cpp(code.text) + "\n" + kCalls + "}  // " + space + "\n";
}

std::string cpp_namespace(const std::string& material) {
  std::string name = "sklar_" + material;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !in_name(c); }, '_');
  return name;
}

}  // namespace sklar::brdf
