#include "brdf/study/live_sphere.hpp"

#include <bit>
#include <cstdint>

#include "brdf/code/model_code.hpp"
#include "brdf/render/sphere.hpp"
#include "brdf/study/base64.hpp"
#include "brdf/study/figures.hpp"
#include "copula/json_fields.hpp"

namespace sklar::brdf {
namespace {

using json::Json;

constexpr double kSky = 0.25;

std::string little_endian(const std::vector<float>& values) {
  std::string bytes;
  for (const float value : values) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    for (const unsigned shift : {0U, 8U, 16U, 24U}) bytes += static_cast<char>(bits >> shift & 0xFFU);
  }
  return bytes;
}

Json numbers(const Eigen::Array3d& values) {
  return {values(0), values(1), values(2)};
}

}  // namespace

std::string live_sphere_json(const RefinedBrdf& model) {
  SphereOptions options;
  options.size = 128;
  options.supersampling = 1;
  options.environment = [](const Vec3&) { return Rgb::Constant(kSky); };
  const Image image = render_sphere(model, options);
  const double exposure = display_exposure(image);
  const ModelCode code = evaluation_code(model);
  const Json json = {{"glsl", code.text},
                     {"values", base64(little_endian(code.values))},
                     {"light", numbers(options.light_direction.normalized())},
                     {"irradiance", numbers(options.light_irradiance)},
                     {"sky", kSky},
                     {"background", numbers(options.background)},
                     {"radius", options.radius},
                     {"exposure", exposure},
                     {"picture", png_url(to_srgb(image, exposure))}};
  return json.dump();
}

}  // namespace sklar::brdf
