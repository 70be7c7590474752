#pragma once
/// What tests of the refined model fit.

#include "brdf/analytic/synthetic.hpp"
#include "brdf/model/refined_structure.hpp"

namespace sklar::test {

constexpr double kSinglePrecision = 2e-5;  ///< relative, of RefinedBrdf::eval against the value in double

/// Two components of few coefficients.
inline brdf::RefinedStructure small_structure() {
  return {.components = 2,
          .half = 8,
          .difference = 6,
          .colour_half = 4,
          .colour_difference = 4,
          .azimuth = 2,
          .azimuth_difference = 4,
          .coupling_difference = 4};
}

inline const brdf::MeasuredTable& builtin_table() {
  static const brdf::MeasuredTable kTable = brdf::builtin_material();
  return kTable;
}

}  // namespace sklar::test
