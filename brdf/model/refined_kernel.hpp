#pragma once
/// The vector kernel that evaluates a refined model, in single precision, in the widest instruction set of the machine.

#include <cstddef>
#include <new>
#include <vector>

#include "brdf/model/direction_rows.hpp"
#include "brdf/model/refined_structure.hpp"

namespace sklar::brdf {

/// Storage that begins on a cache line, so that a vector of 512 bits is one access.
template <class Value>
struct CacheLineAllocator {
  using value_type = Value;
  static constexpr std::align_val_t kLine{64};

  CacheLineAllocator() = default;
  template <class Other>
  explicit CacheLineAllocator(const CacheLineAllocator<Other>&) {}

  [[nodiscard]] Value* allocate(std::size_t count) {
    return static_cast<Value*>(::operator new(count * sizeof(Value), kLine));
  }
  void deallocate(Value* from, std::size_t) { ::operator delete(from, kLine); }

  friend bool operator==(const CacheLineAllocator&, const CacheLineAllocator&) { return true; }
};

/// Numbers that begin on a line of the cache.
using AlignedFloats = std::vector<float, CacheLineAllocator<float>>;

/// AxisRange::place as x stretch - low, cut off at 0 and 1.
struct PlacedAxis {
  explicit PlacedAxis(const AxisRange& range)
      : stretch(static_cast<float>(AxisRange::kWhole) / static_cast<float>(range.high - range.low)),
        low(static_cast<float>(range.low) / static_cast<float>(range.high - range.low)) {}

  float stretch, low;
};

/// A model as evaluation reads it: the components side by side, kMostComponents numbers each, those beyond the model's
/// with a density of e^-80. Colours, powers and couplings stand at the nodes of the Lattice.
struct RefinedTables {
  int half, difference;  ///< spline coefficients of shape
  int powers_pairs;      ///< half the degree in azimuth, rounded up
  float width;
  bool on_part;  ///< of the axes, else neither of these is needed
  PlacedAxis half_axis, difference_axis;
  AlignedFloats shape{};     ///< [difference][half][component]
  AlignedFloats colour{};    ///< [difference][half][red / green, blue / green][component], not logs
  AlignedFloats powers{};    ///< [difference][power 0, 1, .., an even number][component], see azimuth_powers
  AlignedFloats coupling{};  ///< [difference][half][azimuth][component] log c; empty without one
};

/// f_r of count pairs of unit directions, red green blue of row i at out[i], out[stride + i] and out[2 stride + i]; 0
/// where one of them is not above the horizon. What a row gives does not depend on the others.
void evaluate_refined(const RefinedTables& tables, const DirectionRows& wo, const DirectionRows& wi,
                      std::ptrdiff_t count, double* out, std::ptrdiff_t stride);

}  // namespace sklar::brdf
