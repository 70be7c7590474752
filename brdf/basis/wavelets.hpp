#pragma once
/// Haar wavelets on the grid of the tables, thresholded.
///
/// Lalonde and Fournier 1997, "A Wavelet Representation of Reflectance Functions", IEEE TVCG 3(4): coefficients of a
/// tabulated reflectance in a tree, the least of them dropped with all below them. Here with Haar's wavelets: a box of
/// cells is halved across its longest side, the mean of the box is passed down, and the difference of the halves' means
/// is the coefficient, orthogonal for unequal halves too (Girardi and Sweldens 1997, "A New Class of Unbalanced Haar
/// Wavelets").
///
/// Fitted to f_r in linear space; those coefficients stay that have, or stand above one that has, the largest share of
/// the squared error with the mean log_weight of the channels over valid cells. The value is one for all of a box that
/// is not halved any more: piecewise constant. Positions are stored as two bits a coefficient, whether either half is
/// halved again, with a count every 64 bits; the numbers are half floats, and of the first sixteenth, whose rounding
/// all that is below them shares, what rounding left as well. Truncation leaves means of boxes, which rounding can take
/// below 0. Reciprocal, since coordinates are the same for (wo, wi) and (wi, wo).

#include <cstdint>

#include "brdf/basis/half_array.hpp"
#include "brdf/basis/info.hpp"

namespace sklar::brdf {

class Wavelets final : public Brdf {
 public:
  /// Coefficients in breadth-first order.
  struct Tree {
    Eigen::Array3f mean = Eigen::Array3f::Zero();  ///< of the whole table
    std::array<HalfArray, 3> difference;           ///< first half minus second
    std::array<HalfArray, 3> rest;                 ///< what rounding left of the first of them, refined(count)
    std::vector<std::uint64_t> halved;             ///< bits 2 n, 2 n + 1: the first, second half of n has a coefficient
  };

  /// @throws std::invalid_argument if the bits do not describe as many coefficients as there are, at least one.
  explicit Wavelets(Tree tree);

  using Brdf::eval;
  [[nodiscard]] Rgb eval(const Vec3& wo, const Vec3& wi) const override;
  [[nodiscard]] Traits traits() const override { return {.non_negative = false}; }

  /// Mean, coefficients, bits and counts.
  [[nodiscard]] std::size_t bytes() const override { return bytes(tree_.difference[0].size()); }
  [[nodiscard]] static std::size_t bytes(std::size_t coefficients);

  /// How many of so many coefficients are stored as two numbers: one in sixteen.
  [[nodiscard]] static constexpr std::size_t refined(std::size_t coefficients) { return (coefficients + 15) / 16; }

 private:
  Tree tree_;
  std::vector<std::uint32_t> ones_before_;  ///< of each word of bits
};

namespace basis::wavelets {

[[nodiscard]] BasisInfo info();

}  // namespace basis::wavelets
}  // namespace sklar::brdf
