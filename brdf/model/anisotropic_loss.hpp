#pragma once
/// The error of an anisotropic model over the cells of one theta_d and its derivatives: the inner loop of the fit, in
/// single precision, in the widest instruction set of the machine.

#include <array>
#include <vector>

#include "brdf/model/anisotropic_kernel.hpp"
#include "brdf/model/refined_loss.hpp"

namespace sklar::brdf {

/// Cells of one theta_d in blocks of kPointBlock; weight 0 where nothing was measured.
struct AnisotropicSlice {
  double difference = 0;  ///< Warped::difference
  std::array<std::vector<float>, 3> measured{};
  std::vector<float> cos_i{}, cos_o{}, weight{};
  AnisotropicPoints points{};
};

/// One number for each of those of AnisotropicTables, the shape along half alone: [component][half].
struct AnisotropicSums {
  std::vector<float> shape{}, terms{}, red{}, blue{}, metric{};

  AnisotropicSums() = default;
  explicit AnisotropicSums(const AnisotropicTables& model);
};

/// Sum over the cells. @param model with the shape of the slice, [component][half]. @param slopes derivatives by the
/// numbers of `model`.
[[nodiscard]] double anisotropic_loss(const LossWeights& weights, const AnisotropicSlice& slice,
                                      const AnisotropicTables& model, AnisotropicSums& slopes);

/// Second derivatives by the numbers of `model`, as Gauss and Newton have them, without what changes the sign of a
/// slope.
[[nodiscard]] AnisotropicSums anisotropic_curvature(const LossWeights& weights, const AnisotropicSlice& slice,
                                                    const AnisotropicTables& model);

}  // namespace sklar::brdf
