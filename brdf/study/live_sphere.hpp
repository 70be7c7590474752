#pragma once
/// What a page needs to draw a sphere of a fitted model by the model's own numbers.

#include <string>

#include "brdf/model/refined_brdf.hpp"

namespace sklar::brdf {

/// A JSON object: "glsl" and "values", evaluation_code, the numbers in single precision, little-endian, in base64; the
/// scene: "light", a direction in the viewer's frame, "irradiance" and "sky", the radiance from everywhere;
/// "background", "radius" and "exposure" as in SphereOptions and display_exposure; and "picture", a PNG as URL, what
/// render_sphere makes of it with one sample a pixel.
[[nodiscard]] std::string live_sphere_json(const RefinedBrdf& model);

}  // namespace sklar::brdf
