#pragma once
/// The error of a refined model over the cells of one theta_d of a table, and its derivatives: the inner loop of the
/// fit, in single precision, in the widest instruction set of the machine.

#include <cstddef>
#include <vector>

namespace sklar::brdf {

inline constexpr int kLossRows = 90;     ///< theta_h bins
inline constexpr int kLossColumns = 16;  ///< azimuths sampled in a quarter turn

/// How much each measure of error counts. With f measured, g the model, c the cosine of either direction and
/// w = max(cos_i cos_o, 1e-3), the absolute values rounded off within `softness`:
struct LossWeights {
  float log1p = 0;         ///< |ln(1 + f c) - ln(1 + g c)|, mean of both directions
  float log_relative = 0;  ///< |ln((f w + 1e-3) / (g w + 1e-3))|
  float cube_root = 0;     ///< (cbrt(f c) - cbrt(g c))^2, mean of both
  float likelihood = 0;    ///< g - f + f ln(f / g) times cos_i cos_o: minus the log likelihood of a Poisson process
  float image = 0;         ///< ((f - g) c)^2, mean of both, times 1 / mean of (f c)^2
  float softness = 0.003F;
};

/// The cells of one theta_d, [row][column].
struct LossSlice {
  std::vector<float> measured[3], cos_i, cos_o, azimuth, weight;  ///< weight 0 where nothing was measured

  LossSlice();
};

/// The model at the theta_d of the slice: log densities without azimuth, and what azimuth adds.
struct LossModel {
  int components, degree;
  std::vector<float> log_value;  ///< [channel][component][row]
  std::vector<float> powers;     ///< [component][degree], power 1 first
  std::vector<float> coupling;   ///< [component][row][column] log c; empty without one
};

/// Sum over the cells. @param slopes derivatives by the numbers of `model`, in the same shape.
[[nodiscard]] double slice_loss(const LossWeights& weights, const LossSlice& slice, const LossModel& model,
                                LossModel& slopes);

}  // namespace sklar::brdf
