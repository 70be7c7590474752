#include <algorithm>

#include "brdf/code/model_code.hpp"
#include "brdf/code/shader_files.hpp"
#include "brdf/code/source_text.hpp"
#include "brdf/model/warp.hpp"

namespace sklar::brdf {
namespace {

std::string structure_text(const AnisotropicStructure& s) {
  const int shared = shared_terms(s);
  return constant_text("components", s.components) + constant_text("half", s.half) +
         constant_text("difference", s.difference) + constant_text("azimuth", s.azimuth) +
         constant_text("azimuth_difference", s.azimuth_difference) + constant_text("masking", s.masking) +
         constant_text("masking_harmonics", s.masking_harmonics) + constant_text("half_harmonics", s.half_harmonics) +
         constant_text("half_harmonics_degree", s.half_harmonics_degree) + constant_text("colour_half", s.colour_half) +
         constant_text("colour_difference", s.colour_difference) + constant_text("shared_count", shared) +
         constant_text("shared_room", std::max(shared, 1)) + constant_text("colour_count", colour_terms(s)) +
         constant_text("pole", kPole);
}

}  // namespace

ModelCode evaluation_code(const AnisotropicModel& model) {
  const AnisotropicLayout layout(model.structure());
  const AnisotropicTables tables = anisotropic_tables(model.structure(), unpack(layout, model.coefficients()));
  ModelCode code{structure_text(model.structure()), {}};
  const auto append = [&](const char* name, const std::vector<float>& numbers) {
    code.text += constant_text(name, static_cast<int>(code.values.size()));
    code.values.insert(code.values.end(), numbers.begin(), numbers.end());
  };
  append("shape", tables.shape);
  append("shared", tables.terms);
  append("red", tables.red);
  append("blue", tables.blue);
  append("metric", tables.metric);
  code.text.append("\n").append(code::common()).append("\n").append(code::anisotropic());
  return code;
}

}  // namespace sklar::brdf
