#include "brdf/sampling/sampler_mixture.hpp"

#include <numbers>

#include "brdf/sampling/sampler_copula.hpp"

namespace sklar::brdf {
namespace {

constexpr std::size_t kPolarCells = kPolarKnots - 1;
constexpr std::size_t kAzimuthCells = kAzimuthKnots - 1;
constexpr double kLeastMass = 1e-6;  // of a knot, in its share of uniform
constexpr double kLoosened = 0.02;
constexpr double kSmoothing = 0.003;  // a step; less leaves noise of the points in the margins, more blurs lobes

/// Knots of a margin in double.
template <std::size_t Knots>
struct Knotted {
  std::array<double, Knots> density, cdf;

  explicit Knotted(const HatMargin<Knots>& margin) {
    for (std::size_t i = 0; i < Knots; ++i) density[i] = margin.density(i);
    cdf[0] = 0;
    for (std::size_t i = 1; i < Knots; ++i) {
      cdf[i] = cdf[i - 1] + (density[i - 1] + density[i]) / (2 * HatMargin<Knots>::kCells);
    }
  }
  template <class Place>
  [[nodiscard]] double density_at(const Place& p) const {
    return density[p.cell] + p.inside * (density[p.cell + 1] - density[p.cell]);
  }
  template <class Place>
  [[nodiscard]] double cdf_at(const Place& p) const {
    return cdf[p.cell] + p.inside * (density[p.cell] + density_at(p)) / (2 * HatMargin<Knots>::kCells);
  }
};

template <std::size_t Knots>
void normalise(HatMargin<Knots>& margin) {
  double total = 0;
  for (const double mass : margin.mass) total += mass;
  for (std::size_t i = 0; i < Knots; ++i) {
    double& mass = margin.mass[i];
    mass = (total > 0 ? mass / total : HatMargin<Knots>::area(i)) * (1 - kLeastMass) +
           kLeastMass * HatMargin<Knots>::area(i);
  }
}

/// Moves a little of each density towards its neighbours'.
template <std::size_t Knots>
void smooth(HatMargin<Knots>& margin) {
  using Margin = HatMargin<Knots>;
  const HatMargin<Knots> old = margin;
  for (std::size_t i = 0; i < Knots; ++i) {
    const double left = old.density(i == 0 ? 1 : i - 1), right = old.density(i == Margin::kCells ? i - 1 : i + 1);
    margin.mass[i] += kSmoothing * Margin::area(i) * (left + right - 2 * old.density(i));
  }
}

template <std::size_t Knots>
void loosen(HatMargin<Knots>& margin) {
  for (std::size_t i = 0; i < Knots; ++i) {
    double& mass = margin.mass[i];
    mass += kLoosened * (HatMargin<Knots>::area(i) - mass);
  }
}

template <std::size_t Knots>
void tabulate(const HatMargin<Knots>& margin, MarginRow<Knots>& out) {
  const Knotted<Knots> knots(margin);
  for (std::size_t i = 0; i < Knots; ++i) {
    out[2 * i] = static_cast<float>(knots.density[i]);
    out[2 * i + 1] = static_cast<float>(knots.cdf[i]);
  }
  out.back() = 1;
}

/// Adds `weight` of a point to the hat functions it is made of.
template <std::size_t Knots, class Place>
void add(std::array<double, Knots>& sums, const Knotted<Knots>& knots, const Place& p, double weight) {
  const double share = weight / knots.density_at(p);
  sums[p.cell] += share * (1 - p.inside) * knots.density[p.cell];
  sums[p.cell + 1] += share * p.inside * knots.density[p.cell + 1];
}

}  // namespace

MixtureState MixtureState::start() {
  MixtureState state;
  state.polar.fill(HatMargin<kPolarKnots>::uniform());
  state.azimuth.fill(HatMargin<kAzimuthKnots>::uniform());
  state.share = {0.7, 0.1, 0.1, 0.1};
  state.dependence.fill(0);
  return state;
}

MixtureState MixtureState::loosened() const {
  MixtureState state = *this;
  for (std::size_t k = 0; k < kSamplerComponents; ++k) {
    loosen(state.polar[k]);
    loosen(state.azimuth[k]);
    state.share[k] += kLoosened * (start().share[k] - state.share[k]);
  }
  return state;
}

SamplerNode MixtureState::node() const {
  SamplerNode node;
  for (std::size_t k = 0; k < kSamplerComponents; ++k) {
    tabulate<kPolarKnots>(polar[k], node.polar[k]);
    tabulate<kAzimuthKnots>(azimuth[k], node.azimuth[k]);
    node.share[k] = static_cast<float>(share[k]);
    node.dependence[k] = static_cast<float>(dependence[k]);
  }
  return node;
}

struct MixtureProblem::Margins {
  std::vector<Knotted<kPolarKnots>> polar;
  std::vector<Knotted<kAzimuthKnots>> azimuth;

  explicit Margins(const MixtureState& state)
      : polar(state.polar.begin(), state.polar.end()), azimuth(state.azimuth.begin(), state.azimuth.end()) {}
};

/// What the components say of a point.
struct MixtureProblem::Terms {
  std::array<double, kSamplerComponents> top;   ///< cdf where wi meets the horizon
  std::array<double, kSamplerComponents> part;  ///< of the density
  double pdf;
};

struct MixtureProblem::Sums {
  std::array<std::array<double, kPolarKnots>, kSamplerComponents> polar{};
  std::array<std::array<double, kAzimuthKnots>, kSamplerComponents> azimuth{};
  std::array<std::array<double, kPolarKnots + 1>, kSamplerComponents> beyond{};  ///< running sums from a knot on
  std::array<double, kSamplerComponents> share{};
};

MixtureProblem::MixtureProblem(const std::vector<TargetPoint>& points, const SamplerWidths& width2, double cosine_share)
    : cosine_share_(cosine_share) {
  const auto place = [](double coordinate, std::size_t cells) {
    const double position = coordinate * static_cast<double>(cells);
    const std::size_t cell = std::min(static_cast<std::size_t>(position), cells - 1);
    return Place{cell, position - static_cast<double>(cell)};
  };
  for (const TargetPoint& point : points) {
    const WiCoordinates& at = point.at;
    Row row{.polar = {place(at.radius2, kPolarCells)},
            .most = {place(1, kPolarCells)},
            .azimuth = {place(at.azimuth, kAzimuthCells)},
            .measure = {at.measure},
            .cosine_pdf = std::sqrt(std::max(1 - at.radius2, 0.0)) * std::numbers::inv_pi,
            .mass = point.mass,
            .solid_angle = point.measure};
    for (std::size_t k = 1; k < kSamplerComponents; ++k) {
      const double scale = 1 / (at.slope2 + width2[k]);
      row.polar[k] = place(at.slope2 * scale, kPolarCells);
      row.most[k] = place(at.slope2_most / (at.slope2_most + width2[k]), kPolarCells);
      row.azimuth[k] = place(at.half_azimuth, kAzimuthCells);
      row.measure[k] = at.half_measure * width2[k] * scale * scale;
    }
    rows_.push_back(row);
  }
}

MixtureProblem::Terms MixtureProblem::terms(const Margins& margins, const MixtureState& state, const Row& row) const {
  Terms result;
  result.pdf = cosine_share_ * row.cosine_pdf;
  for (std::size_t k = 0; k < kSamplerComponents; ++k) {
    const double theta = state.dependence[k];
    const double u = margins.polar[k].cdf_at(row.polar[k]), v = margins.azimuth[k].cdf_at(row.azimuth[k]);
    const double z = k == 0 ? 1 - v : v;
    result.top[k] = margins.polar[k].cdf_at(row.most[k]);
    const double coupled = sampler_copula::truncated_density(theta, 1 - u, result.top[k], 1 - result.top[k], z);
    result.part[k] = (1 - cosine_share_) * state.share[k] * margins.polar[k].density_at(row.polar[k]) *
                     margins.azimuth[k].density_at(row.azimuth[k]) * coupled * row.measure[k];
    result.pdf += result.part[k];
  }
  return result;
}

double MixtureProblem::variance(const MixtureState& state) const {
  const Margins margins(state);
  double square = 0, total = 0;
  for (const Row& row : rows_) {
    const double part = row.solid_angle * terms(margins, state, row).pdf;
    square += row.mass * row.mass / part;
    total += part;  // 1 but for the error of the quadrature, of which this takes out the most
  }
  return std::max(square * total - 1, 0.0);
}

void MixtureProblem::step(MixtureState& state, bool variance) const {
  const Margins margins(state);
  Sums sums;
  for (const Row& row : rows_) {
    if (!(row.mass > 0)) continue;
    const Terms term = terms(margins, state, row);
    const double wanted = variance ? row.mass * (row.mass / (row.solid_angle * term.pdf)) : row.mass;
    for (std::size_t k = 0; k < kSamplerComponents; ++k) {
      const double weight = wanted * term.part[k] / term.pdf;
      if (!(weight > 0)) continue;
      sums.share[k] += weight;
      add(sums.polar[k], margins.polar[k], row.polar[k], weight);
      add(sums.azimuth[k], margins.azimuth[k], row.azimuth[k], weight);
      if (k == 0) continue;
      // What the horizon hides: as many points as the component would have beyond it.
      const Place& most = row.most[k];
      const double hidden = weight / term.top[k], f = most.inside;
      const auto& mass = state.polar[k].mass;
      const double here = 1 - ((most.cell > 0 ? 0.5 : 0.0) + f - f * f / 2) / (most.cell > 0 ? 1.0 : 0.5);
      const double next = 1 - f * f / 2 / (most.cell + 2 == kPolarKnots ? 0.5 : 1.0);
      sums.polar[k][most.cell] += hidden * here * mass[most.cell];
      sums.polar[k][most.cell + 1] += hidden * next * mass[most.cell + 1];
      sums.beyond[k][most.cell + 2] += hidden;
    }
  }
  double total = 0;
  for (std::size_t k = 0; k < kSamplerComponents; ++k) {
    double hidden = 0;
    for (std::size_t i = 0; i < kPolarKnots; ++i) {
      hidden += sums.beyond[k][i];
      state.polar[k].mass[i] = sums.polar[k][i] + hidden * state.polar[k].mass[i];
    }
    state.azimuth[k].mass = sums.azimuth[k];
    normalise(state.polar[k]);
    normalise(state.azimuth[k]);
    smooth(state.polar[k]);
    smooth(state.azimuth[k]);
    normalise(state.polar[k]);
    normalise(state.azimuth[k]);
    total += sums.share[k];
  }
  for (std::size_t k = 0; k < kSamplerComponents; ++k) state.share[k] = total > 0 ? sums.share[k] / total : k == 0;
}

/// The dependence of each component that raises the likelihood most, by golden sections.
void MixtureProblem::fit_dependence(MixtureState& state) const {
  struct Point {
    double weight, rest, top, z;
  };
  std::array<std::vector<Point>, kSamplerComponents> points;
  const Margins margins(state);
  for (const Row& row : rows_) {
    if (!(row.mass > 0)) continue;
    const Terms term = terms(margins, state, row);
    for (std::size_t k = 0; k < kSamplerComponents; ++k) {
      const double v = margins.azimuth[k].cdf_at(row.azimuth[k]);
      points[k].push_back({row.mass * term.part[k] / term.pdf, 1 - margins.polar[k].cdf_at(row.polar[k]), term.top[k],
                           k == 0 ? 1 - v : v});
    }
  }
  for (std::size_t k = 0; k < kSamplerComponents; ++k) {
    const auto likelihood = [&](double theta) {
      double sum = 0;
      for (const Point& p : points[k]) {
        sum += p.weight * std::log(sampler_copula::truncated_density(theta, p.rest, p.top, 1 - p.top, p.z));
      }
      return sum;
    };
    constexpr double kGolden = std::numbers::phi - 1;
    double low = sampler_copula::kLowestDependence, high = sampler_copula::kHighestDependence;
    double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
    double at_a = likelihood(a), at_b = likelihood(b);
    for (int n = 0; n < 8; ++n) {
      if (at_a > at_b) {
        high = b, b = a, at_b = at_a, a = high - kGolden * (high - low), at_a = likelihood(a);
      } else {
        low = a, a = b, at_a = at_b, b = low + kGolden * (high - low), at_b = likelihood(b);
      }
    }
    state.dependence[k] = (state.dependence[k] + (low + high) / 2) / 2;  // half-way: the margins follow
  }
}

MixtureState MixtureProblem::solve(MixtureState state, const Steps& steps) const {
  for (int n = 0; n < steps.likelihood + steps.variance; ++n) {
    step(state, n >= steps.likelihood);
    if (steps.dependence_every > 0 && n % steps.dependence_every == steps.dependence_every - 1) fit_dependence(state);
  }
  return state;
}

}  // namespace sklar::brdf
