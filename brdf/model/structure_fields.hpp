#pragma once
/// The counts of a model's structure by name, in the order in which they are stored.

#include <type_traits>

#include "brdf/model/anisotropic_structure.hpp"
#include "brdf/model/refined_structure.hpp"

namespace sklar::brdf {

/// action(name, range) for the ranges of a refined model.
template <class Structure, class Action>
void for_each_range(Structure& structure, const Action& action) {
  action("half_range", structure.half_range);
  action("difference_range", structure.difference_range);
}

/// action(name, count) for each.
template <class Structure, class Action>
void for_each_count(Structure& structure, const Action& action) {
  action("components", structure.components);
  action("half", structure.half);
  action("difference", structure.difference);
  if constexpr (std::is_same_v<std::remove_const_t<Structure>, AnisotropicStructure>) {
    action("masking", structure.masking);
    action("masking_harmonics", structure.masking_harmonics);
    action("half_harmonics", structure.half_harmonics);
    action("half_harmonics_degree", structure.half_harmonics_degree);
  } else {
    action("coupling_difference", structure.coupling_difference);
  }
  action("colour_half", structure.colour_half);
  action("colour_difference", structure.colour_difference);
  action("azimuth", structure.azimuth);
  action("azimuth_difference", structure.azimuth_difference);
}

}  // namespace sklar::brdf
