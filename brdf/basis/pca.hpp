#pragma once
/// Principal components of other materials in log-relative space.
///
///     ln((f_r w + e) / (f_ref w + e)) = mu + sum_k c_k q_k,   w = max(cos_i cos_o, 1e-3), e = 1e-3
///
/// Nielsen, Jensen and Ramamoorthi 2015, "On Optimal, Minimal BRDF Sampling for Reflectance Acquisition":
/// f_ref is the median over the materials, mu the mean and q_k the principal components of their channels, each channel
/// an observation; c by ridge regression with weight 40 on components scaled to unit variance of their coefficients,
/// over 3e4 cells that stand for all, each counting once.
///
/// The paper keeps a value of every component in each cell of the tables, 8 MB. To fit a budget the components stand on
/// fewer nodes, between which ln(f_ref w + e) + mu and the q_k are interpolated linearly; number of components and of
/// nodes by the least log_error. bytes() counts all of them, though several materials could share all but c.
/// f_r = (exp(.) - e) / w can be as low as -e / w. Reciprocal, since coordinates and w are the same both ways.

#include "brdf/basis/cell_grid.hpp"
#include "brdf/basis/half_array.hpp"
#include "brdf/basis/info.hpp"

namespace sklar::brdf {

class PcaBrdf final : public Brdf {
 public:
  /// @param base ln(f_ref w + e) + mu on the cells of the grid. @param components q_k on them.
  /// @param coefficients c_k of each channel. @throws std::invalid_argument if sizes do not agree.
  PcaBrdf(const CellGrid& grid, HalfArray base, std::vector<HalfArray> components,
          std::array<std::vector<float>, 3> coefficients);

  using Brdf::eval;
  [[nodiscard]] Rgb eval(const Vec3& wo, const Vec3& wi) const override;
  [[nodiscard]] Traits traits() const override { return {.non_negative = false}; }

  /// Base, components, coefficients and the grid, two bytes a side.
  [[nodiscard]] std::size_t bytes() const override {
    return bytes(static_cast<std::size_t>(grid_.cells()), components_.size());
  }
  [[nodiscard]] static constexpr std::size_t bytes(std::size_t cells, std::size_t components) {
    return 6 + (components + 1) * HalfArray::bytes(cells) + 3 * components * sizeof(float);
  }

 private:
  CellGrid grid_;
  HalfArray base_;
  std::vector<HalfArray> components_;
  std::array<std::vector<float>, 3> coefficients_;
};

namespace basis::pca {

[[nodiscard]] BasisInfo info();

}  // namespace basis::pca
}  // namespace sklar::brdf
