#pragma once
/// A compact reflectance model: a mixture of K components, each a density of (theta_h, folded phi_d) given theta_d
/// built from two margins and a copula,
///
///   f_r = sum_k exp(A_k(half, difference) + R_k,c(half, difference) + sum_m P_k,m(difference) azimuth^m)
///             c_k(F_k(half | difference), G_k(azimuth | difference); tau_k(difference))
///
/// in the coordinates of Warped. A (log weight and margin of theta_h), R (how red and blue differ from green) and P
/// (log margin of phi_d) are cubic tensor splines; c_k is the copula of a registered family, or 1. exp(R), P and log c
/// are linear between the nodes of the Lattice. The cells below the horizon take no part in a fit, so the density is
/// that of the truncated distribution.

#include <vector>

#include "brdf/brdf.hpp"
#include "brdf/model/refined_kernel.hpp"
#include "brdf/model/refined_structure.hpp"
#include "brdf/model/warp.hpp"
#include "copula/family.hpp"

namespace sklar::brdf {

/// What RefinedBrdf::bytes says of a model of this structure and layout.
[[nodiscard]] std::size_t refined_bytes(const RefinedStructure& structure, const RefinedLayout& layout, int bits);

class RefinedBrdf final : public Brdf {
 public:
  /// @param families one a component; independence for c = 1.
  /// @throws std::invalid_argument for counts out of range or that do not agree, a family that cannot couple;
  /// std::domain_error for coefficients with which f_r could exceed e^80.
  RefinedBrdf(const RefinedStructure& structure, std::vector<FamilyInfo> families, PackedCoefficients coefficients);

  using Brdf::eval;
  [[nodiscard]] Rgb eval(const Vec3& wo, const Vec3& wi) const override;
  [[nodiscard]] Traits traits() const override { return {}; }

  /// The structure and the ranges, one byte a component for its family, and the levels.
  [[nodiscard]] std::size_t bytes() const override;

  /// Bytes of the tables that evaluation reads, made of the coefficients on construction.
  [[nodiscard]] std::size_t expanded_bytes() const;

  /// The value in double at `coordinates`; eval is within a relative 2e-5 of it, at most points within 1e-6.
  [[nodiscard]] Rgb at(const Warped& w) const;

  [[nodiscard]] const RefinedStructure& structure() const { return structure_; }
  [[nodiscard]] const std::vector<FamilyInfo>& families() const { return families_; }
  [[nodiscard]] const PackedCoefficients& coefficients() const { return packed_; }
  [[nodiscard]] const RefinedLayout& layout() const { return layout_; }

  /// What evaluation reads.
  [[nodiscard]] const RefinedTables& tables() const { return tables_; }

  /// Kendall's tau of a component's copula at theta_d [radians]; 0 where it has none.
  [[nodiscard]] double tau(int component, double theta_d) const;

 private:
  void eval_batch(const DirectionsRef& wo, const DirectionsRef& wi, Eigen::Ref<RgbRows> out) const override;
  [[nodiscard]] int even_azimuth() const { return structure_.azimuth + structure_.azimuth % 2; }
  void expand();
  void expand_component(int component);
  void require_bounded() const;
  [[nodiscard]] std::vector<double> part(int component, RefinedPart part) const;

  RefinedStructure structure_;
  std::vector<FamilyInfo> families_;
  PackedCoefficients packed_;
  RefinedLayout layout_;
  std::vector<double> unpacked_{};
  RefinedTables tables_;
};

}  // namespace sklar::brdf
