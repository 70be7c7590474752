#include "brdf/model/refined_structure.hpp"

#include <stdexcept>

#include "brdf/model/spline.hpp"
#include "copula/error.hpp"

namespace sklar::brdf {
namespace {

constexpr int kMostCoefficients = 128;  // along an axis

void require_count(const char* field, int value, int lowest, int highest) {
  if (value >= lowest && value <= highest) return;
  throw std::invalid_argument("refined model: " + std::string(field) + " is " + std::to_string(value) +
                              ", allowed are " + std::to_string(lowest) + " to " + std::to_string(highest));
}

/// One coefficient is a constant.
void require_colour_count(const char* field, int value) {
  if (value == 1 || (value >= kSplineOrder && value <= kMostCoefficients)) return;
  throw std::invalid_argument("refined model: " + std::string(field) + " is " + std::to_string(value) +
                              ", allowed are 1 and " + std::to_string(kSplineOrder) + " to " +
                              std::to_string(kMostCoefficients));
}

void require_range(const char* field, const AxisRange& range) {
  if (0 <= range.low && range.low < range.high && range.high <= AxisRange::kWhole) return;
  throw std::invalid_argument("refined model: " + std::string(field) + " is " + std::to_string(range.low) + " to " +
                              std::to_string(range.high) + ", allowed are ranges within 0 to " +
                              std::to_string(AxisRange::kWhole));
}

}  // namespace

void require_structure(const RefinedStructure& structure) {
  require_count("components", structure.components, 1, kMostComponents);
  require_count("half", structure.half, kSplineOrder, kMostCoefficients);
  require_count("difference", structure.difference, kSplineOrder, kMostCoefficients);
  require_colour_count("colour_half", structure.colour_half);
  require_colour_count("colour_difference", structure.colour_difference);
  require_count("azimuth", structure.azimuth, 0, kHighestDegree);
  require_count("azimuth_difference", structure.azimuth_difference, kSplineOrder, kMostCoefficients);
  require_count("coupling_difference", structure.coupling_difference, kSplineOrder, kMostCoefficients);
  if (!(structure.width > 0 && structure.width <= 100)) {
    throw std::invalid_argument("refined model: width is " + sklar::to_text(structure.width) +
                                ", allowed are (0, 100]");
  }
  require_range("half_range", structure.half_range);
  require_range("difference_range", structure.difference_range);
}

bool is_whole(const RefinedStructure& structure) {
  return structure.half_range.whole() && structure.difference_range.whole();
}

bool in_ranges(const RefinedStructure& structure, const Vec3& wo, const Vec3& wi) {
  const Warped w = warp(structure.width, wo, wi);
  return structure.half_range.contains(w.half) && structure.difference_range.contains(w.difference);
}

Warped coordinates(const RefinedStructure& structure, const Vec3& wo, const Vec3& wi) {
  Warped w = warp(structure.width, wo, wi);
  w.half = structure.half_range.place(w.half);
  w.difference = structure.difference_range.place(w.difference);
  return w;
}

RefinedLayout::RefinedLayout(const RefinedStructure& structure, const std::vector<bool>& coupled) : first_{0} {
  const int colour = structure.colour_half * structure.colour_difference;
  for (const bool copula : coupled) {
    for (const int count :
         {structure.half * structure.difference, colour, colour, structure.azimuth * structure.azimuth_difference,
          copula ? structure.coupling_difference : 0}) {
      first_.push_back(first_.back() + count);
    }
  }
}

std::vector<CoefficientRun> RefinedLayout::runs(int bits) const {
  std::vector<CoefficientRun> result;
  for (int k = 0; k < components(); ++k) {
    for (const RefinedPart part : kRefinedParts) {
      result.push_back({.part = static_cast<std::size_t>(part),
                        .first = static_cast<std::size_t>(first(k, part)),
                        .count = static_cast<std::size_t>(count(k, part)),
                        .bits = bits});
    }
  }
  return result;
}

}  // namespace sklar::brdf
