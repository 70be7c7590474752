#pragma once
/// Warnings on stderr where a model that was fitted to a part of its axes is asked for more.

#include <span>
#include <string>

#include "brdf/render/scene.hpp"

namespace sklar::cli {

/// How many of the pairs a material's model was not fitted to.
void warn_of_pairs(const std::string& name, const brdf::Brdf& material, const brdf::Directions& wo,
                   const brdf::Directions& wi);

/// Where more than a hundredth of the light that a material reflects in a scene is such.
/// @param names of the materials, those of the scene's objects.
void warn_of_scene(const brdf::Scene& scene, std::span<const std::string> names,
                   std::span<const brdf::BrdfPtr> materials);

}  // namespace sklar::cli
