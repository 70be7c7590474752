#pragma once
/// Isotropic functions of two directions as series over orthogonal functions of each.
///
///     s(a, b) = sum_m cos(m dphi) sum_jk C_mjk R_mj(a) R_mk(b)
///
/// dphi is the difference of the azimuths; R are the radial parts of functions on the sphere or the hemisphere, the
/// azimuthal parts of which are cos(m phi) and sin(m phi): that only their products with equal m and the cosine of
/// dphi occur is what isotropy and mirror symmetry leave (Koenderink, van Doorn and Stavridi 1996).

#include <array>

#include "brdf/basis/half_array.hpp"
#include "brdf/brdf.hpp"
#include "brdf/data/measured_table.hpp"

namespace sklar::brdf {

/// Radial parts R_mj, j = 0 to count(order, m) - 1, for m = 0 to order.
struct RadialFunctions {
  static constexpr int kMostOrder = 60;

  int (*count)(int order, int m);
  void (*values)(int order, int m, const Vec3& w, double* out);  ///< at a direction, count(order, m) of them
};

/// What a series of one order needs.
struct SeriesShape {
  RadialFunctions radial;
  int order;
  bool symmetric;  ///< C_mjk = C_mkj, stored once

  /// Coefficients of one channel. @pre order at most RadialFunctions::kMostOrder.
  [[nodiscard]] std::size_t coefficients() const;

  /// Of three channels, and one for the order.
  [[nodiscard]] std::size_t bytes() const { return 1 + 3 * HalfArray::bytes(coefficients()); }
};

class AzimuthalSeries {
 public:
  /// @param coefficients of each channel, m by m, j by j, k fastest and from j on where symmetric.
  /// @throws std::invalid_argument unless there are as many as the shape has.
  AzimuthalSeries(const SeriesShape& shape, std::array<HalfArray, 3> coefficients);

  /// s(a, b); where symmetric the same to the last bit for (b, a). @param a, b unit, above the horizon.
  [[nodiscard]] Rgb sum(const Vec3& a, const Vec3& b) const;

  [[nodiscard]] const SeriesShape& shape() const { return shape_; }

 private:
  SeriesShape shape_;
  std::array<HalfArray, 3> coefficients_;
};

/// The series of f_r, or of f_r cos(theta_i) with a = wi, by least squares over both directions: 90 x 90 polar angles
/// and 180 dphi, where the table is read between its valid cells. An error of f_r counts by dwi cos_i dwo cos_o, one of
/// f_r cos_i by dwi dwo cos_o; a ridge of 1e-6 of the mean diagonal a side keeps functions that the hemisphere does not
/// tell apart small. @pre f_cos or symmetric, not both.
[[nodiscard]] AzimuthalSeries fit_series(const MeasuredTable& table, const SeriesShape& shape, bool f_cos);

/// The largest order, at most `most`, whose series fits. @throws std::invalid_argument naming the model if none does.
[[nodiscard]] SeriesShape largest_series(const char* model, const SeriesShape& most, double max_bytes);

}  // namespace sklar::brdf
