#pragma once
/// Which part of a reflectance a scene shows.

#include <memory>

#include "brdf/model/cell_importance.hpp"
#include "brdf/model/refined_structure.hpp"
#include "brdf/render/path_tracer.hpp"

namespace sklar::brdf {

/// By the light that reaches the camera.
struct SceneUse {
  std::shared_ptr<const CellImportance> importance;  ///< of the cells, 1 in the mean; a thousandth where none came
  AxisRange half_range, difference_range;            ///< of all but a thousandth of the light
  std::size_t reflections = 0;                       ///< counted
};

/// Counts the reflections of render_paths at one material in bins of half/difference angles, each spread evenly over
/// its neighbours.
/// @param width of warp. @throws std::invalid_argument as light_uses; std::runtime_error where the picture shows none.
[[nodiscard]] SceneUse scene_use(const Scene& scene, const Brdf& material, double width, const PathOptions& options);

/// The share of the light of a picture that a material reflects outside of the ranges of a structure.
[[nodiscard]] double share_outside(const Scene& scene, const Brdf& material, const RefinedStructure& structure,
                                   const PathOptions& options);

}  // namespace sklar::brdf
