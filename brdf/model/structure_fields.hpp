#pragma once
/// What both forms of model files share: the counts of a structure by name, in the order in which they are stored, and
/// how a family is named.

#include <stdexcept>
#include <string>
#include <type_traits>

#include "brdf/model/anisotropic_structure.hpp"
#include "brdf/model/refined_structure.hpp"
#include "copula/error.hpp"
#include "families/registry.hpp"

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

/// The family of that name, or of a whole definition. @throws std::invalid_argument, for the reader to name the file.
inline FamilyInfo stored_family(const std::string& name) {
  try {
    return name.starts_with('{') ? families::from_definition(name, "family") : families::find(name);
  } catch (const FileError& error) {
    throw std::invalid_argument(error.what());
  }
}

}  // namespace sklar::brdf
