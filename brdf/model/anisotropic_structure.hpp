#pragma once
/// The size of an anisotropic model and where its coefficients stand.

#include <array>
#include <vector>

#include "brdf/model/packed_coefficients.hpp"

namespace sklar::brdf {

/// How many coefficients of each kind a component has. Harmonics are cos 2 m phi and sin 2 m phi, m = 1 to the number
/// given; degrees are those of Bernstein polynomials.
struct AnisotropicStructure {
  int components = 4;          ///< 1 to kMostAnisotropicComponents
  int half = 14;               ///< spline coefficients of the log density along the elliptic half coordinate, 4 to 64
  int difference = 7;          ///< and along difference, 4 to 64
  int colour_half = 2;         ///< degree in half of log red / green and log blue / green, 0 to 6
  int colour_difference = 3;   ///< and in difference
  int azimuth = 2;             ///< degree in azimuth, 0 to 6
  int azimuth_difference = 3;  ///< and in difference
  int masking = 4;             ///< degree in the cosine of each direction, 0 to 6
  int masking_harmonics = 2;   ///< of the azimuth of each direction, 0 to 2
  int half_harmonics = 1;      ///< of phi_h, 0 to 2
  int half_harmonics_degree = 2;  ///< in half
  bool tilted = false;            ///< lobes may stand off the normal: f_r(phi_h + pi) differs from f_r(phi_h)

  friend bool operator==(const AnisotropicStructure&, const AnisotropicStructure&) = default;
};

/// The most components, and the bits of a number of their ellipses.
inline constexpr int kMostAnisotropicComponents = 8;
inline constexpr int kMetricBits = 16;

/// @throws std::invalid_argument naming the field, its value and what is allowed.
void require_structure(const AnisotropicStructure& structure);

/// Terms of the log density that are linear in their coefficients, one after another.
struct TermGroup {
  int count;
  bool harmonic;  ///< the sum of their absolute values is at most 1; else they are not negative, and their sum is
};
/// The groups in the order of the coefficients.
[[nodiscard]] std::vector<TermGroup> term_groups(const AnisotropicStructure& structure);

/// Numbers of terms: of the log density, and of a colour.
[[nodiscard]] int shared_terms(const AnisotropicStructure& structure);
[[nodiscard]] int colour_terms(const AnisotropicStructure& structure);

/// The parts of a component's coefficients. shape is column-major, half x difference; metric is that of Metric.
enum class AnisotropicPart { shape, terms, red, blue, metric };
inline constexpr std::array<AnisotropicPart, 5> kAnisotropicParts = {AnisotropicPart::shape, AnisotropicPart::terms,
                                                                     AnisotropicPart::red, AnisotropicPart::blue,
                                                                     AnisotropicPart::metric};

/// Component after component, part after part.
class AnisotropicLayout {
 public:
  explicit AnisotropicLayout(const AnisotropicStructure& structure);

  [[nodiscard]] int size() const { return components_ * stride_; }
  [[nodiscard]] std::vector<CoefficientRun> runs(int bits) const;  ///< the metric with kMetricBits
  [[nodiscard]] int first(int component, AnisotropicPart part) const {
    return component * stride_ + first_[static_cast<std::size_t>(part)];
  }
  [[nodiscard]] int count(AnisotropicPart part) const { return count_[static_cast<std::size_t>(part)]; }

 private:
  int components_, stride_ = 0;
  std::array<int, kAnisotropicParts.size()> first_{}, count_{};
};

/// The elliptic metric of a component: the square of the distance of a half vector h from the axis is
/// u' M u, u = (h_x - x h_z, h_y - y h_z), and M = exp(scale) exp([a b; b -a]).
struct Metric {
  double xx, xy, yy;  ///< M
  double x, y;        ///< slope of the axis; 0 unless tilted

  /// sqrt(sqrt(q)) / (sqrt(sqrt(q)) + sqrt(h_z)), in [0,1], of the squared distance q of a unit h.
  [[nodiscard]] double half(double h_x, double h_y, double h_z) const;

  /// @param coefficients scale, a, b, and if tilted x, y.
  static Metric from(const double* coefficients, bool tilted);

  /// Derivatives by the coefficients, given those by xx, xy, yy, x, y.
  static void pull_back(const double* coefficients, bool tilted, const std::array<double, 5>& by, double* gradient);
};

}  // namespace sklar::brdf
