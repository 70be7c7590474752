#pragma once
/// Linear regression on explanatory variables of the directions.
///
///     f_r(wi, wo) = sum_a C_a T_a1(z_1) T_a2(z_2) T_a3(z_3) T_a4(z_4),   a1 + a2 + a3 + a4 <= degree
///
/// Ozturk, Kurt, Bilgili and Gungor 2008, "Linear approximation of Bidirectional Reflectance Distribution Functions",
/// Computers & Graphics 32: a polynomial response surface in principal components z of variables that are functions of
/// the directions, linear in its coefficients. The abstract says so much; the list of variables could not be checked
/// against the paper, and these are chosen here: cos_i cos_o, cos(theta_d), cos(theta_h) and sqrt(sin(theta_h)), each
/// in units of its standard deviation. Being the same both ways they make the model reciprocal, and isotropic.
///
/// The components are scaled to [-1, 1] over the cells, and the monomials written in Chebyshev polynomials T, which
/// span the same. Fitted to f_r in linear space by least squares over 2e4 of the cells with the mean log_weight of the
/// channels. Can be negative. The degree ends at 8, 495 terms, 3 KB: normal equations of more take minutes.

#include "brdf/basis/half_array.hpp"
#include "brdf/basis/info.hpp"

namespace sklar::brdf {

/// Principal components of the explanatory variables, scaled to [-1, 1].
struct ExplanatoryComponents {
  static constexpr int kCount = 4;
  using Values = Eigen::Array<double, kCount, 1>;

  Eigen::Matrix<float, kCount, kCount> turn;  ///< z = turn variables + shift
  Eigen::Array<float, kCount, 1> shift;

  /// cos_i cos_o, cos(theta_d), cos(theta_h), sqrt(sin(theta_h)); the same to the last bit for (wi, wo).
  [[nodiscard]] static Values variables(const Vec3& wo, const Vec3& wi);

  [[nodiscard]] Values at(const Vec3& wo, const Vec3& wi) const;
};

class LinearExplanatory final : public Brdf {
 public:
  static constexpr int kMostDegree = 8;

  /// @param coefficients of each channel, in the order of powers that for_each_term goes through.
  /// @throws std::invalid_argument unless the degree is at most kMostDegree and there are terms(degree) of each.
  LinearExplanatory(const ExplanatoryComponents& components, int degree, std::array<HalfArray, 3> coefficients);

  using Brdf::eval;
  [[nodiscard]] Rgb eval(const Vec3& wo, const Vec3& wi) const override;
  [[nodiscard]] Traits traits() const override { return {.non_negative = false}; }

  /// The coefficients, the transformation to components, and one for the degree.
  [[nodiscard]] std::size_t bytes() const override { return bytes(degree_); }
  [[nodiscard]] static std::size_t bytes(int degree);

  /// Number of products of total degree at most `degree` of four variables.
  [[nodiscard]] static std::size_t terms(int degree);

  /// The products at the components, in order. @param out terms(degree) of them.
  static void products(const ExplanatoryComponents::Values& z, int degree, double* out);

 private:
  ExplanatoryComponents components_;
  int degree_;
  std::array<HalfArray, 3> coefficients_;
};

namespace basis::linear_explanatory {

[[nodiscard]] BasisInfo info();

}  // namespace basis::linear_explanatory
}  // namespace sklar::brdf
