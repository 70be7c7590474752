#pragma once
/// Distant light around a scene.

#include <functional>

#include "brdf/brdf.hpp"

namespace sklar::brdf {

/// Radiance arriving from a unit direction, in the viewer's frame: x right, y up, z toward the viewer. Pure and
/// thread-safe.
using Environment = std::function<Rgb(const Vec3& direction)>;

/// The default: a blue sky over warm ground and two soft boxes, one at the upper left, a narrow one at the right.
/// Radiance is between 0.1 and 4.6 in every channel.
[[nodiscard]] Rgb studio_environment(const Vec3& direction);

}  // namespace sklar::brdf
