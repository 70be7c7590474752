#pragma once
/// A picture of one sphere of anisotropic material.

#include "brdf/render/sphere.hpp"

namespace sklar::brdf {

/// The sphere of render_sphere as if turned on a lathe about the vertical: the x axis of the surface lies along the
/// circles of latitude, y along the meridians. The environment's share is computed once a pixel, by the quadrature of
/// hemisphere_nodes with half the nodes along the polar angle and two thirds along the azimuth; the light's share and
/// the outline at every sub-pixel. Costs that many evaluations a pixel, whatever the material; isotropic ones are
/// cheaper by render_sphere. Depends on the arguments alone.
/// @return size x size, linear. @throws std::invalid_argument as render_sphere, not for anisotropy.
[[nodiscard]] Image render_turned_sphere(const Brdf& brdf, const SphereOptions& options = {});

}  // namespace sklar::brdf
