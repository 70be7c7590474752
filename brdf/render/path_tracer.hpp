#pragma once
/// Pictures of scenes by path tracing.

#include <cstdint>
#include <vector>

#include "brdf/progress.hpp"
#include "brdf/render/image.hpp"
#include "brdf/render/scene.hpp"

namespace sklar::brdf {

/// How a picture is traced.
struct PathOptions {
  int samples = 64;  ///< paths a pixel; powers of two are spread best
  std::uint64_t seed = 1;
  bool draw_lights = true;  ///< false: paths meet lights by chance alone, and directional lights never
  Progress progress{};
};

/// The radiance that reaches each pixel, a mean over paths from the camera through the whole pixel. At each surface one
/// light is drawn and one direction by Brdf::sample, joined by the power heuristic (Veach and Guibas 1995, "Optimally
/// Combining Sampling Techniques for Monte Carlo Rendering", sec. 4); from the fifth reflection on, paths end by
/// Russian roulette. Unbiased but for the depth of the scene. Where the interpolated normal of a mesh turns away from
/// the viewer, that of the triangle is taken. The bytes depend on the arguments alone: not on threads.
/// @throws std::invalid_argument as require_scene, and unless samples is at least 1.
[[nodiscard]] Image render_paths(const Scene& scene, const PathOptions& options = {});

/// One reflection by which light reaches the camera, in the frame of the surface.
struct LightUse {
  Vec3 wo, wi;
  double light;  ///< what it adds to the picture as seen: d sum of (exposure luminance)^(1/2.2) / d log f_r
};

/// All reflections of the paths of render_paths at surfaces of a material, in an order that does not depend on threads.
/// @param material one of the scene's, by its address.
/// @throws std::invalid_argument as render_paths.
[[nodiscard]] std::vector<LightUse> light_uses(const Scene& scene, const Brdf& material,
                                               const PathOptions& options = {});

}  // namespace sklar::brdf
