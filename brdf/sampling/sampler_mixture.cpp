#include "brdf/sampling/sampler_mixture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "brdf/sampling/disk_warp.hpp"

namespace sklar::brdf {
namespace {

constexpr double kLeastMass = 1e-6;   // of a knot, in its share of uniform
constexpr double kSmoothing = 0.003;  // a step; less leaves noise of the points in the margins, more blurs lobes

/// Where a coordinate lies between knots.
struct Place {
  std::size_t cell;
  double inside;

  Place(double coordinate, std::size_t cells) {
    const double position = coordinate * static_cast<double>(cells);
    cell = std::min(static_cast<std::size_t>(position), cells - 1);
    inside = position - static_cast<double>(cell);
  }
};

/// A margin by its densities at the knots.
template <std::size_t Cells>
struct Knots {
  std::array<double, Cells + 1> density;

  void take(const HatMargin<Cells>& margin) {
    for (std::size_t i = 0; i <= Cells; ++i) density[i] = margin.density(i);
  }
  [[nodiscard]] double at(const Place& p) const {
    return density[p.cell] + p.inside * (density[p.cell + 1] - density[p.cell]);
  }
  /// Adds `weight` of a point to the hat functions it is made of.
  void add(HatMargin<Cells>& sums, const Place& p, double weight) const {
    const double share = weight / at(p);
    double* mass = sums.mass.data() + p.cell;
    mass[0] += share * (1 - p.inside) * density[p.cell];
    mass[1] += share * p.inside * density[p.cell + 1];
  }
};

/// @param density at the knots, not normalised.
template <std::size_t Cells, class Density>
HatMargin<Cells> margin_of(const Density& density) {
  HatMargin<Cells> margin;
  double total = 0;
  for (std::size_t i = 0; i <= Cells; ++i) total += margin.mass[i] = margin.area(i) * density(i);
  for (double& mass : margin.mass) mass /= total;
  return margin;
}

/// The margin of the sums of a step, with a little of uniform, a little of each density moved to its neighbours.
template <std::size_t Cells>
HatMargin<Cells> settled(const HatMargin<Cells>& sums) {
  double total = 0;
  for (const double mass : sums.mass) total += mass;
  if (!(total > 0)) return HatMargin<Cells>::uniform();
  const auto density = [&](std::size_t i) { return sums.density(i) / total * (1 - kLeastMass) + kLeastMass; };
  return margin_of<Cells>([&](std::size_t i) {
    const double left = density(i == 0 ? 1 : i - 1), right = density(i == Cells ? i - 1 : i + 1);
    return density(i) + kSmoothing * (left + right - 2 * density(i));
  });
}

template <std::size_t Cells>
void move(HatMargin<Cells>& margin, const HatMargin<Cells>& a, const HatMargin<Cells>& b, double amount) {
  for (std::size_t i = 0; i <= Cells; ++i) {
    margin.mass[i] += amount * ((a.mass[i] + b.mass[i]) / 2 - margin.mass[i]);
  }
}

template <const SamplerKind& Kind>
void move(KindState<Kind>& state, const KindState<Kind>& a, const KindState<Kind>& b, double amount) {
  for (std::size_t k = 0; k < Kind.components; ++k) {
    move(state.polar[k], a.polar[k], b.polar[k], amount);
    move(state.azimuth[k], a.azimuth[k], b.azimuth[k], amount);
    state.share[k] += amount * ((a.share[k] + b.share[k]) / 2 - state.share[k]);
  }
}

template <std::size_t Components, std::size_t Cells>
void tabulate(const std::array<HatMargin<Cells>, Components>& margins, MarginTable<Components, Cells>& out) {
  for (std::size_t k = 0; k < Components; ++k) {
    const HatMargin<Cells>& margin = margins[k];
    out.density[0][k] = static_cast<float>(margin.density(0));
    double cdf = 0;
    for (std::size_t i = 0; i < Cells; ++i) {
      out.density[i + 1][k] = static_cast<float>(margin.density(i + 1));
      cdf += (margin.density(i) + margin.density(i + 1)) / (2 * Cells);
      out.cdf[k][i] = static_cast<float>(cdf);
    }
    out.cdf[k].back() = 1;
  }
}

/// A point in the coordinates of one kind.
struct At {
  Place polar, azimuth;
  double measure;
};

template <const SamplerKind& Kind>
struct KindMargins {
  std::array<Knots<Kind.polar_cells>, Kind.components> polar;
  std::array<Knots<Kind.azimuth_cells>, Kind.components> azimuth;

  explicit KindMargins(const KindState<Kind>& state) {
    for (std::size_t k = 0; k < Kind.components; ++k) {
      polar[k].take(state.polar[k]);
      azimuth[k].take(state.azimuth[k]);
    }
  }

  [[nodiscard]] double density(std::size_t k, const At& at) const {
    return polar[k].at(at.polar) * azimuth[k].at(at.azimuth) * at.measure;
  }
};

template <const SamplerKind& Kind>
KindState<Kind> nothing() {
  KindState<Kind> sums;
  for (auto& margin : sums.polar) margin.mass.fill(0);
  for (auto& margin : sums.azimuth) margin.mass.fill(0);
  sums.share.fill(0);
  return sums;
}

/// Adds a point. @param per_density of the point, what the state's density there stands for.
template <const SamplerKind& Kind>
void add(KindState<Kind>& sums, const KindState<Kind>& state, const KindMargins<Kind>& margins, const At& at,
         double per_density) {
  for (std::size_t k = 0; k < Kind.components; ++k) {
    const double weight = per_density * state.share[k] * margins.density(k, at);
    sums.share[k] += weight;
    margins.polar[k].add(sums.polar[k], at.polar, weight);
    margins.azimuth[k].add(sums.azimuth[k], at.azimuth, weight);
  }
}

template <const SamplerKind& Kind>
void settle(KindState<Kind>& sums, double total) {
  for (std::size_t k = 0; k < Kind.components; ++k) {
    sums.polar[k] = settled(sums.polar[k]);
    sums.azimuth[k] = settled(sums.azimuth[k]);
    sums.share[k] /= total;
  }
}

template <const SamplerKind& Kind>
double total_share(const KindState<Kind>& state) {
  double total = 0;
  for (const double share : state.share) total += share;
  return total;
}

}  // namespace

MixtureState MixtureState::start() {
  MixtureState state;
  for (std::size_t k = 0; k < kOfHalf.components; ++k) {
    const double middle = (static_cast<double>(k) + 0.5) / kOfHalf.components;
    state.half.polar[k] = margin_of<kOfHalf.polar_cells>([&](std::size_t i) {
      const double away = static_cast<double>(i) / kOfHalf.polar_cells - middle;
      return std::exp(-8 * away * away);
    });
  }
  state.half.azimuth.fill(HatMargin<kOfHalf.azimuth_cells>::uniform());
  state.half.share.fill(0.6 / kOfHalf.components);
  state.wi.share.fill(0.4 / kOfWi.components);
  state.wi.polar.fill(HatMargin<kOfWi.polar_cells>::uniform());
  state.wi.azimuth.fill(HatMargin<kOfWi.azimuth_cells>::uniform());
  const auto rising = [](std::size_t cells) {
    return [cells](std::size_t i) { return 0.2 + 1.6 * static_cast<double>(i) / static_cast<double>(cells); };
  };
  state.wi.polar.back() = margin_of<kOfWi.polar_cells>(rising(kOfWi.polar_cells));
  state.wi.azimuth.back() = margin_of<kOfWi.azimuth_cells>(rising(kOfWi.azimuth_cells));
  return state;
}

MixtureState MixtureState::without_light() {
  MixtureState state = start();
  state.half.share.fill(0);
  state.wi.share.fill(0);
  state.wi.share.front() = 1;
  return state;
}

MixtureState MixtureState::towards(const MixtureState& a, const MixtureState& b, double amount) const {
  MixtureState state = *this;
  move(state.half, a.half, b.half, amount);
  move(state.wi, a.wi, b.wi, amount);
  return state;
}

SamplerNode MixtureState::node(double spread) const {
  SamplerNode node;
  tabulate(half.polar, node.half_polar);
  tabulate(half.azimuth, node.half_azimuth);
  tabulate(wi.polar, node.wi_polar);
  tabulate(wi.azimuth, node.wi_azimuth);
  node.shares.fill(1);
  node.shares[0] = 0;
  double sum = 0;
  for (std::size_t k = 0; k + 1 < kSamplerComponents; ++k) {
    sum += k < kOfHalf.components ? half.share[k] : wi.share[k - kOfHalf.components];
    node.shares[k + 1] = static_cast<float>(std::min(sum, 1.0));
  }
  node.spread = static_cast<float>(spread);
  return node;
}

struct MixtureProblem::Row {
  At half, wi;
  double cosine_pdf, mass, solid_angle;
};

struct MixtureProblem::Margins {
  KindMargins<kOfHalf> half;
  KindMargins<kOfWi> wi;

  explicit Margins(const MixtureState& state) : half(state.half), wi(state.wi) {}
};

MixtureProblem::MixtureProblem(const std::vector<TargetPoint>& points, double spread, double cosine_share)
    : cosine_share_(cosine_share) {
  const DiskWarp warp(spread);
  rows_.reserve(points.size());
  for (const TargetPoint& point : points) {
    const WiCoordinates& at = point.at;
    const DiskWarp::Place polar = warp.of(at.disk2);
    rows_.push_back({.half = {Place(polar.coordinate, kOfHalf.polar_cells),
                              Place(at.disk_azimuth, kOfHalf.azimuth_cells), polar.slope * at.disk_measure},
                     .wi = {Place(at.radius2, kOfWi.polar_cells), Place(at.azimuth, kOfWi.azimuth_cells), at.measure},
                     .cosine_pdf = std::sqrt(std::max(1 - at.radius2, 0.0)) * std::numbers::inv_pi,
                     .mass = point.mass,
                     .solid_angle = point.measure});
  }
}

MixtureProblem::MixtureProblem(MixtureProblem&&) noexcept = default;
MixtureProblem::~MixtureProblem() = default;

double MixtureProblem::pdf(const Margins& margins, const MixtureState& state, const Row& row) const {
  double sum = 0;
  for (std::size_t k = 0; k < kOfHalf.components; ++k) sum += state.half.share[k] * margins.half.density(k, row.half);
  for (std::size_t k = 0; k < kOfWi.components; ++k) sum += state.wi.share[k] * margins.wi.density(k, row.wi);
  return (1 - cosine_share_) * sum + cosine_share_ * row.cosine_pdf;
}

double MixtureProblem::step(MixtureState& state, bool towards_variance) const {
  const Margins margins(state);
  MixtureState sums{nothing<kOfHalf>(), nothing<kOfWi>()};
  double square = 0, whole = 0;
  for (const Row& row : rows_) {
    const double density = pdf(margins, state, row), part = row.solid_angle * density;
    whole += part;  // 1 but for the error of the quadrature, of which this takes out the most
    if (!(row.mass > 0)) continue;
    const double weight = row.mass / part;
    square += row.mass * weight;
    const double wanted = (towards_variance ? row.mass * weight : row.mass) / density;
    add(sums.half, state.half, margins.half, row.half, wanted);
    add(sums.wi, state.wi, margins.wi, row.wi, wanted);
  }
  const double total = total_share(sums.half) + total_share(sums.wi);
  if (total > 0) {
    settle(sums.half, total);
    settle(sums.wi, total);
    state = sums;
  }
  return square * whole - 1;
}

void MixtureProblem::follow_light(MixtureState& state) const {
  (void)step(state, false);
}

void MixtureProblem::lower_variance(MixtureState& state, int steps) const {
  MixtureState at = state;
  double least = std::numeric_limits<double>::infinity();
  for (int n = 0; n <= steps; ++n) {
    const MixtureState here = at;
    const double variance = step(at, true);
    if (variance < least) {
      least = variance;
      state = here;
    }
  }
}

}  // namespace sklar::brdf
