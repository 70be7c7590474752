#pragma once
/// One node of a ConditionalSampler while it is fitted, in double.

#include <array>
#include <vector>

#include "brdf/sampling/sampler_tables.hpp"
#include "brdf/sampling/sampler_target.hpp"

namespace sklar::brdf {

/// Masses of the hat functions of a margin's knots, sum 1.
template <std::size_t Cells>
struct HatMargin {
  std::array<double, Cells + 1> mass;

  /// Integral of the hat function of a knot whose height is 1.
  static constexpr double area(std::size_t knot) { return (knot == 0 || knot == Cells ? 0.5 : 1.0) / Cells; }

  static HatMargin uniform() {
    HatMargin margin;
    for (std::size_t i = 0; i <= Cells; ++i) margin.mass[i] = area(i);
    return margin;
  }
  [[nodiscard]] double density(std::size_t knot) const { return mass[knot] / area(knot); }
};

/// The components of one kind.
template <const SamplerKind& Kind>
struct KindState {
  std::array<HatMargin<Kind.polar_cells>, Kind.components> polar;
  std::array<HatMargin<Kind.azimuth_cells>, Kind.components> azimuth;
  std::array<double, Kind.components> share;
};

/// The components while they are fitted.
struct MixtureState {
  KindState<kOfHalf> half;
  KindState<kOfWi> wi;

  /// Components over the half vector one beyond the other, one over wi uniform and one towards grazing in the plane of
  /// incidence.
  static MixtureState start();

  /// Where there is no light to follow: wi uniform in radius2 and azimuth.
  static MixtureState without_light();

  /// Moved by `amount` towards the mean of two others.
  [[nodiscard]] MixtureState towards(const MixtureState& a, const MixtureState& b, double amount) const;

  [[nodiscard]] SamplerNode node(double spread) const;
};

/// The points of one theta_o and the steps on them.
class MixtureProblem {
 public:
  MixtureProblem(const std::vector<TargetPoint>& points, double spread, double cosine_share);
  MixtureProblem(MixtureProblem&&) noexcept;
  ~MixtureProblem();

  /// A step of expectation maximisation towards f.
  void follow_light(MixtureState& state) const;

  /// Steps towards f^2 / pdf, which lower the variance of the weight f cos / pdf; leaves the state of the least.
  void lower_variance(MixtureState& state, int steps) const;

 private:
  struct Row;
  struct Margins;

  /// Of the state at a point, per solid angle.
  [[nodiscard]] double pdf(const Margins& margins, const MixtureState& state, const Row& row) const;

  /// @param towards_variance follows f^2 / pdf, else f. @return the relative variance of the weight before.
  double step(MixtureState& state, bool towards_variance) const;

  std::vector<Row> rows_;
  double cosine_share_;
};

}  // namespace sklar::brdf
