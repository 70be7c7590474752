#pragma once
/// A picture of one sphere: environment and one directional light, no Monte Carlo.

#include "brdf/progress.hpp"
#include "brdf/render/environment.hpp"
#include "brdf/render/hemisphere.hpp"
#include "brdf/render/image.hpp"

namespace sklar::brdf {

/// How the sphere is lit and drawn.
struct SphereOptions {
  int size = 256;         ///< pixels a side
  double radius = 0.92;   ///< of the sphere, in half sides of the picture
  int supersampling = 4;  ///< sub-pixels a side
  Environment environment = studio_environment;
  Vec3 light_direction{0.45, 0.65, 0.75};  ///< toward the light, any length, viewer's frame
  Rgb light_irradiance{1.3, 1.25, 1.15};   ///< on a plane that faces the light
  Rgb background{0.05, 0.05, 0.055};
  bool swap_directions = false;                         ///< evaluate f(wi, wo): equal pictures show reciprocity
  HemisphereOptions nodes{.polar = 96, .azimuth = 96};  ///< of the environment's quadrature
  Progress progress;
};

/// @throws std::invalid_argument naming the function and the option that is out of range.
void require_sphere_options(std::string_view function, const SphereOptions& options);

/// The orthographic view of a sphere of an isotropic material. The environment's share is computed on rings of equal
/// theta_o, where one set of BRDF values serves all azimuths, by the quadrature of hemisphere_nodes; the light's share
/// and the outline at every sub-pixel. With the default nodes measured tables are 74 dB or more (PSNR after gamma) from
/// the converged picture. Depends on the arguments alone: not on threads, not on chance.
/// @return size x size, linear. @throws std::invalid_argument if the BRDF claims anisotropy or an option is out of
/// range.
[[nodiscard]] Image render_sphere(const Brdf& brdf, const SphereOptions& options = {});

}  // namespace sklar::brdf
