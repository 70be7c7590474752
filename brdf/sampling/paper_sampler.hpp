#pragma once
/// The sampler of Ozturk, Kurt and Bilgili, section 7: one Archimedean copula over wo and wi, conditional on wo.
///
/// f_r, seen as a density over the angles, is tabulated; its cells give the margins and, by least squares (Eq. 17), the
/// parameter of the copula. theta_i and then phi_i solve Eqs. 26 and 27, which the paper leaves to numerical methods:
/// by Copula::inverse_rosenblatt, whose inverses are closed-form where the family has them (Frank: a quadratic given
/// two coordinates, a cubic given three). The density of wi per solid angle is that of (theta_i, phi_i) over
/// sin(theta_i).
///
/// The estimator as printed follows f_r alone (Eq. 23), so that cos(theta_i) sin(theta_i) stays in the weight (Eq. 24,
/// which must read K h in place of h). The corrected one has them in what is tabulated.

#include "brdf/brdf.hpp"
#include "copula/family.hpp"
#include "copula/inference/marginal.hpp"

namespace sklar::brdf {

/// What the copula is fitted to.
enum class PaperTarget {
  reflectance,      ///< f_r, as printed
  reflected_light,  ///< f_r cos(theta_i) sin(theta_i)
};

/// The coordinates of the copula.
enum class PaperCoordinates {
  isotropic,  ///< theta_o, theta_i, |phi_i - phi_o|
  full,       ///< theta_o, phi_o, theta_i, phi_i
};

/// f_r of another Brdf, sampled so. A draw allocates; the other calls do not.
class PaperSampledBrdf final : public Brdf {
 public:
  /// @param family with one parameter. Runs on all threads; about 200,000 evaluations of f_r.
  /// @throws std::invalid_argument for no brdf; for an anisotropic one in isotropic coordinates. std::runtime_error
  /// where the copula cannot be fitted.
  PaperSampledBrdf(BrdfPtr brdf, const FamilyInfo& family, PaperTarget target,
                   PaperCoordinates coordinates = PaperCoordinates::isotropic);

  using Brdf::eval;
  [[nodiscard]] Rgb eval(const Vec3& wo, const Vec3& wi) const override { return brdf_->eval(wo, wi); }
  [[nodiscard]] double pdf(const Vec3& wo, const Vec3& wi) const override;
  [[nodiscard]] Traits traits() const override { return brdf_->traits(); }

  /// Of the reflectance, and four bytes for each mass and the parameter.
  [[nodiscard]] std::size_t bytes() const override;

  /// K h(wo) cos(theta_i) sin(theta_i), the weight of Eq. 24: what f_r cos / pdf is where f_r is the copula's density
  /// itself. Precondition: PaperTarget::reflectance.
  [[nodiscard]] double printed_weight(const Vec3& wo, const Vec3& wi) const;

  /// K c f1 f2 ..: the luminance of f_r as the copula has it (Eq. 13 in these angles), of f_r cos sin for that target.
  [[nodiscard]] double modelled(const Vec3& wo, const Vec3& wi) const;

  [[nodiscard]] const Theta& theta() const { return theta_; }

 protected:
  [[nodiscard]] Vec3 sample_direction(const Vec3& wo, const Vec2& uniforms) const override;

 private:
  struct Point {
    std::array<double, 4> angle, u;
  };
  [[nodiscard]] std::size_t given() const { return margins_.size() - 2; }
  [[nodiscard]] Point place(const Vec3& wo, const Vec3& wi) const;
  /// Natural log of the density of the first coordinates, wo's.
  [[nodiscard]] double log_given(const Point& point) const;
  /// Natural log of the density of all.
  [[nodiscard]] double log_joint(const Point& point) const;

  BrdfPtr brdf_;
  std::vector<HistogramMarginal> margins_{};
  Theta theta_{};
  CopulaPtr copula_, copula_of_wo_{};  ///< the latter only where wo has two coordinates
  double log_scale_ = 0;               ///< log K
};

}  // namespace sklar::brdf
