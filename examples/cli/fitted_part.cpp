#include "examples/cli/fitted_part.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>

#include "brdf/model/refined_brdf.hpp"
#include "brdf/sampling/sampled_brdf.hpp"
#include "brdf/study/scene_use.hpp"

namespace sklar::cli {
namespace {

/// The structure of a refined model, with or without a sampler, of part of its axes; else none.
const brdf::RefinedStructure* part_of(const brdf::Brdf& material) {
  const auto* sampled = dynamic_cast<const brdf::SampledBrdf*>(&material);
  const auto* model = dynamic_cast<const brdf::RefinedBrdf*>(sampled != nullptr ? sampled->brdf().get() : &material);
  return model == nullptr || is_whole(model->structure()) ? nullptr : &model->structure();
}

}  // namespace

void warn_of_pairs(const std::string& name, const brdf::Brdf& material, const brdf::Directions& wo,
                   const brdf::Directions& wi) {
  const brdf::RefinedStructure* structure = part_of(material);
  if (structure == nullptr) return;
  Eigen::Index outside = 0;
  for (Eigen::Index row = 0; row < wo.rows(); ++row) {
    const bool above = wo(row, 2) > 0 && wi(row, 2) > 0;
    if (above && !in_ranges(*structure, wo.row(row), wi.row(row))) ++outside;
  }
  if (outside == 0) return;
  std::cerr << "warning: " << name << " was not fitted to " << outside << " of " << wo.rows()
            << " pairs of directions: there it is as at the nearest place that it was fitted to\n";
}

void warn_of_scene(const brdf::Scene& scene, std::span<const std::string> names,
                   std::span<const brdf::BrdfPtr> materials) {
  constexpr double kFew = 0.01;
  constexpr int kPixels = 64;
  brdf::Scene small = scene;
  small.width = std::min(scene.width, kPixels);
  small.height = std::min(scene.height, kPixels);
  for (std::size_t n = 0; n < materials.size(); ++n) {
    const brdf::RefinedStructure* structure = part_of(*materials[n]);
    if (structure == nullptr) continue;
    const double outside = share_outside(small, *materials[n], *structure, {.samples = 1});
    if (outside <= kFew) continue;
    std::cerr << "warning: " << names[n] << " was not fitted to " << std::lround(100 * outside)
              << " % of the light that it reflects in this scene\n";
  }
}

}  // namespace sklar::cli
