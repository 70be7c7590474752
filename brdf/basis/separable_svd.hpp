#pragma once
/// A sum of products of a function of the half vector and one of the difference vector.
///
///     f_r(wi, wo) = sum_k u_k(theta_h) v_k(theta_d, phi_d),   u per channel
///
/// Fournier 1995, "Separating Reflection Functions for Linear Radiosity": singular value decomposition of a tabulated
/// reflectance. Kautz and McCool 1999, "Interactive Rendering with Arbitrary BRDFs using Separable Approximations":
/// over half and difference vectors instead of wi and wo. For isotropic data a function of the half vector
/// is one of theta_h alone when the difference vector is taken in the frame of h (Rusinkiewicz 1998).
///
/// Fitted to f_r in linear space, by least squares over the nodes with log_weight; the three channels are rows of one
/// matrix, so that they share v. u stands on nodes in sqrt(theta_h), v on nodes in theta_d and phi_d, both
/// interpolated linearly; of rank and numbers of nodes that the budget allows, those with the least log_error are
/// taken. Truncated, the sum can be negative. Reciprocal, since exchanging wi and wo turns phi_d by pi, the period.

#include "brdf/basis/cell_grid.hpp"
#include "brdf/basis/half_array.hpp"
#include "brdf/basis/info.hpp"

namespace sklar::brdf {

class SeparableSvd final : public Brdf {
 public:
  /// A product of a function of theta_h and one of theta_d and phi_d.
  struct Term {
    HalfArray half;        ///< u: 3 theta_h numbers, channel by channel
    HalfArray difference;  ///< v: theta_d phi_d numbers, phi_d fastest
  };

  /// @param grid of the nodes. @param terms sized as the grid says.
  /// @throws std::invalid_argument if a term is not.
  SeparableSvd(const CellGrid& grid, std::vector<Term> terms);

  using Brdf::eval;
  [[nodiscard]] Rgb eval(const Vec3& wo, const Vec3& wi) const override;
  [[nodiscard]] Traits traits() const override { return {.non_negative = false}; }

  /// The terms and the grid, two bytes a side.
  [[nodiscard]] std::size_t bytes() const override { return bytes(grid_, static_cast<int>(terms_.size())); }
  [[nodiscard]] static std::size_t bytes(const CellGrid& grid, int terms);

  [[nodiscard]] const CellGrid& grid() const { return grid_; }
  [[nodiscard]] std::size_t terms() const { return terms_.size(); }

 private:
  CellGrid grid_;
  std::vector<Term> terms_;
};

namespace basis::separable_svd {

[[nodiscard]] BasisInfo info();

}  // namespace basis::separable_svd
}  // namespace sklar::brdf
