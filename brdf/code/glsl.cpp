#include "brdf/code/glsl.hpp"

#include <algorithm>

#include "brdf/code/source_text.hpp"

namespace sklar::brdf {

// In vectors of four: what indexes constants by address gives each entry of an array as much room as a vec4.
std::string glsl_values(const std::vector<float>& values) {
  const std::size_t vectors = (values.size() + 3) / 4;
  const std::string type = "vec4[" + std::to_string(vectors) + "]";
  std::string text = "const vec4 sklar_values[" + std::to_string(vectors) + "] = " + type + "(\n";
  for (std::size_t i = 0; i < vectors; ++i) {
    text += "vec4(";
    for (std::size_t j = 4 * i; j < 4 * i + 4; ++j) {
      text += number_text(j < values.size() ? values[j] : 0.0F) + (j < 4 * i + 3 ? "," : ")");
    }
    text += i + 1 < vectors ? ",\n" : ");\n";
  }
  return text + "\nfloat sklar_value(int i) {\n  return sklar_values[i / 4][i - 4 * (i / 4)];\n}\n\n";
}

std::string to_glsl(const ModelCode& code, const std::string& material) {
  return "// " + origin_text(material) + "\n" + glsl_values(code.values) + code.text;
}

// In a .brdf file a line that begins with # is a comment, in the shader too.
std::string to_brdf_explorer(const ModelCode& code, const std::string& material) {
  return "analytic\n\n# " + origin_text(material) + "\n::begin parameters\n::end parameters\n\n::begin shader\n\n" +
         glsl_values(code.values) + code.text + R"(
vec3 BRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y) {
  return sklar_eval(vec3(dot(V, X), dot(V, Y), dot(V, N)), vec3(dot(L, X), dot(L, Y), dot(L, N)));
}

::end shader
)";
}

}  // namespace sklar::brdf
