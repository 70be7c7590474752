#pragma once
/// The size of a refined model and where its coefficients stand.

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "brdf/model/packed_coefficients.hpp"
#include "brdf/model/warp.hpp"

namespace sklar::brdf {

/// Part of an axis of Warped, in 64ths.
struct AxisRange {
  static constexpr int kWhole = 64;
  int low = 0, high = kWhole;

  [[nodiscard]] bool whole() const { return low == 0 && high == kWhole; }
  /// x in [0,1] as it stands in the range, 0 to 1 again; beyond it as at its end.
  [[nodiscard]] double place(double x) const { return std::clamp((x * kWhole - low) / (high - low), 0.0, 1.0); }
  [[nodiscard]] bool contains(double x) const { return x * kWhole >= low && x * kWhole <= high; }

  friend bool operator==(const AxisRange&, const AxisRange&) = default;
};

/// How many coefficients of each kind a model has; half, difference and azimuth are the axes of Warped.
struct RefinedStructure {
  int components = 6;               ///< 1 to kMostComponents
  int half = 20;                    ///< spline coefficients of a component's log density along half, 4 to 128
  int difference = 12;              ///< and along difference, 4 to 128
  int colour_half = 4;              ///< of log red / green and log blue / green, these or 1: the same everywhere
  int colour_difference = 6;        ///<
  int azimuth = 4;                  ///< degree of the Bernstein polynomials in azimuth, 0 to kHighestDegree
  int azimuth_difference = 8;       ///< spline coefficients of each of its coefficients along difference
  int coupling_difference = 6;      ///< spline coefficients of the dependence along difference, where there is a copula
  double width = 0.05;              ///< of warp, in (0, 100]
  AxisRange half_range = {};        ///< what the model is fitted on; beyond it, it is as at the nearest place there
  AxisRange difference_range = {};  ///<

  friend bool operator==(const RefinedStructure&, const RefinedStructure&) = default;
};

/// Upper bounds of RefinedStructure.
inline constexpr int kMostComponents = 8;
inline constexpr int kHighestDegree = 6;  ///< even

/// @throws std::invalid_argument naming the field, its value and what is allowed.
void require_structure(const RefinedStructure& structure);

/// Whether neither axis is cut.
[[nodiscard]] bool is_whole(const RefinedStructure& structure);

/// Whether a pair of directions is within both ranges.
[[nodiscard]] bool in_ranges(const RefinedStructure& structure, const Vec3& wo, const Vec3& wi);

/// The coordinates in which the splines of a structure stand: those of warp, half and difference placed in its ranges.
[[nodiscard]] Warped coordinates(const RefinedStructure& structure, const Vec3& wo, const Vec3& wi);

/// The parts of a component's coefficients. Matrices are column-major: half x difference, azimuth (Bernstein
/// polynomials 1 to degree) x azimuth_difference.
enum class RefinedPart { shape, red, blue, azimuth, coupling };
inline constexpr std::array<RefinedPart, 5> kRefinedParts = {RefinedPart::shape, RefinedPart::red, RefinedPart::blue,
                                                             RefinedPart::azimuth, RefinedPart::coupling};

/// Component after component, part after part.
class RefinedLayout {
 public:
  /// @param coupled one entry a component: whether it has a copula other than independence.
  RefinedLayout(const RefinedStructure& structure, const std::vector<bool>& coupled);

  [[nodiscard]] int size() const { return first_.back(); }
  [[nodiscard]] int components() const { return static_cast<int>(first_.size() / kRefinedParts.size()); }
  [[nodiscard]] std::vector<CoefficientRun> runs(int bits) const;
  [[nodiscard]] int first(int component, RefinedPart part) const { return first_[index(component, part)]; }
  [[nodiscard]] int count(int component, RefinedPart part) const {
    return first_[index(component, part) + 1] - first_[index(component, part)];
  }

 private:
  static std::size_t index(int component, RefinedPart part) {
    return kRefinedParts.size() * static_cast<std::size_t>(component) + static_cast<std::size_t>(part);
  }
  std::vector<int> first_;
};

}  // namespace sklar::brdf
