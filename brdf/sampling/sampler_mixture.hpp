#pragma once
/// One node of a ConditionalSampler while it is fitted, in double.

#include <array>
#include <vector>

#include "brdf/sampling/sampler_tables.hpp"
#include "brdf/sampling/sampler_target.hpp"

namespace sklar::brdf {

using SamplerWidths = std::array<double, kSamplerComponents>;  ///< width^2; [0] is not used

/// Masses of the hat functions of a margin's knots, sum 1.
template <std::size_t Knots>
struct HatMargin {
  std::array<double, Knots> mass;

  static constexpr std::size_t kCells = Knots - 1;

  /// Integral of the hat function of a knot whose height is 1.
  static constexpr double area(std::size_t knot) { return (knot == 0 || knot == kCells ? 0.5 : 1.0) / kCells; }

  static HatMargin uniform() {
    HatMargin margin;
    for (std::size_t i = 0; i < Knots; ++i) margin.mass[i] = area(i);
    return margin;
  }
  [[nodiscard]] double density(std::size_t knot) const { return mass[knot] / area(knot); }
};

struct MixtureState {
  std::array<HatMargin<kPolarKnots>, kSamplerComponents> polar;
  std::array<HatMargin<kAzimuthKnots>, kSamplerComponents> azimuth;
  std::array<double, kSamplerComponents> share;
  std::array<double, kSamplerComponents> dependence;

  /// All components alike, uniform margins, no dependence.
  static MixtureState start();

  /// Mixed with a little of start(), so that no step is stuck at 0.
  [[nodiscard]] MixtureState loosened() const;

  [[nodiscard]] SamplerNode node() const;
};

/// The points of one theta_o and the steps on them.
class MixtureProblem {
 public:
  MixtureProblem(const std::vector<TargetPoint>& points, const SamplerWidths& width2, double cosine_share);

  struct Steps {
    int likelihood;            ///< that follow f
    int variance;              ///< then, that follow f^2 / pdf
    int dependence_every = 6;  ///< 0: no copulas
  };
  [[nodiscard]] MixtureState solve(MixtureState state, const Steps& steps) const;

  /// Relative variance of the weight f cos / pdf.
  [[nodiscard]] double variance(const MixtureState& state) const;

 private:
  /// Where a coordinate lies between the knots.
  struct Place {
    std::size_t cell;
    double inside;
  };
  struct Row {
    std::array<Place, kSamplerComponents> polar, most, azimuth;
    std::array<double, kSamplerComponents> measure;
    double cosine_pdf, mass, solid_angle;
  };
  struct Margins;
  struct Terms;
  struct Sums;

  [[nodiscard]] Terms terms(const Margins& margins, const MixtureState& state, const Row& row) const;
  void step(MixtureState& state, bool variance) const;
  void fit_dependence(MixtureState& state) const;

  std::vector<Row> rows_{};
  double cosine_share_;
};

}  // namespace sklar::brdf
