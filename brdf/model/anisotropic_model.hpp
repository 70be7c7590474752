#pragma once
/// A compact model of anisotropic reflectance: a mixture of K components, each a lobe with its own ellipse,
///
///   f_r = sum_k exp(A_k(half_k, difference) + T_k(wi, wo) + R_k,c(half, difference))
///
/// half_k is the distance of the half vector from the axis of the component in a metric of its own (as in the exponents
/// of Ward and GGX), half the same in a round metric, difference that of Warped. A is a cubic tensor spline; R tells
/// how red and blue differ from green. T is a sum of low harmonics: what depends on phi_d (polynomials in
/// Warped::azimuth), masking and shadowing (a function of each direction, of its cosine and azimuth) and what remains
/// of phi_h. Everything is algebraic in the components of the directions.

#include <vector>

#include "brdf/brdf.hpp"
#include "brdf/model/anisotropic_kernel.hpp"
#include "brdf/model/anisotropic_structure.hpp"

namespace sklar::brdf {

/// What AnisotropicModel::bytes says of a model of this structure.
[[nodiscard]] std::size_t anisotropic_bytes(const AnisotropicStructure& structure, int bits);

/// The tables of all components. @param coefficients in the order of AnisotropicLayout.
[[nodiscard]] AnisotropicTables anisotropic_tables(const AnisotropicStructure& structure,
                                                   const std::vector<double>& coefficients);

class AnisotropicModel final : public Brdf {
 public:
  /// @throws std::invalid_argument for counts out of range or that do not agree; std::domain_error for coefficients
  /// with which f_r could exceed e^80, and for a metric with a trace above 1e12 or a determinant below 1e-12.
  AnisotropicModel(const AnisotropicStructure& structure, PackedCoefficients coefficients);

  using Brdf::eval;
  [[nodiscard]] Rgb eval(const Vec3& wo, const Vec3& wi) const override;
  [[nodiscard]] Traits traits() const override { return {.isotropic = false}; }

  /// The structure and the ranges, and the levels.
  [[nodiscard]] std::size_t bytes() const override { return anisotropic_bytes(structure_, packed_.bits); }

  [[nodiscard]] const AnisotropicStructure& structure() const { return structure_; }
  [[nodiscard]] const PackedCoefficients& coefficients() const { return packed_; }

  /// The metric of a component.
  [[nodiscard]] Metric metric(int component) const;

 private:
  void eval_batch(const DirectionsRef& wo, const DirectionsRef& wi, Eigen::Ref<RgbRows> out) const override;
  [[nodiscard]] double largest_log() const;

  AnisotropicStructure structure_;
  PackedCoefficients packed_;
  AnisotropicTables tables_;
};

}  // namespace sklar::brdf
