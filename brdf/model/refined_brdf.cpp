#include "brdf/model/refined_brdf.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "brdf/model/coupling.hpp"
#include "brdf/model/spline.hpp"
#include "copula/error.hpp"

namespace sklar::brdf {
namespace {

constexpr double kLargestLog = 80;  // of f_r; e^80 is within single precision
constexpr float kAbsent = -80;      // the log density of a component that is not there

std::vector<bool> coupled(const std::vector<FamilyInfo>& families) {
  std::vector<bool> result;
  for (const FamilyInfo& family : families) result.push_back(!family.parameters.empty());
  return result;
}

/// The matrix of a part in the order of the kernel, with room for every component.
void interleave(const std::vector<double>& values, int component, std::vector<float>& table) {
  table.resize(values.size() * kMostComponents);
  for (std::size_t i = 0; i < values.size(); ++i) {
    table[i * kMostComponents + static_cast<std::size_t>(component)] = static_cast<float>(values[i]);
  }
}

/// The azimuth part as coefficients of powers.
std::vector<double> powers_of(const RefinedStructure& structure, const std::vector<double>& azimuth) {
  const Eigen::Map<const Eigen::MatrixXd> values(azimuth.data(), structure.azimuth, structure.azimuth_difference);
  const Eigen::MatrixXd powers = bernstein_powers(structure.azimuth) * values;
  return {powers.data(), powers.data() + powers.size()};
}

/// A column-major tensor spline.
double tensor(const std::vector<double>& values, int rows, const SplineWeights& across, const SplineWeights& along) {
  double sum = 0;
  for (int j = 0; j < kSplineOrder; ++j) {
    for (int i = 0; i < kSplineOrder; ++i) {
      sum += along.weight[static_cast<std::size_t>(j)] * across.weight[static_cast<std::size_t>(i)] *
             values[static_cast<std::size_t>((along.first + j) * rows + across.first + i)];
    }
  }
  return sum;
}

/// Trilinear between the nodes of the lattice.
double lattice(const RefinedTables& tables, int component, const Warped& w) {
  const auto split = [](double x, int nodes) {
    const int first = std::min(static_cast<int>(x * (nodes - 1)), nodes - 2);
    return std::pair(first, x * (nodes - 1) - first);
  };
  const auto [m, x] = split(w.half, CouplingLattice::half);
  const auto [n, z] = split(w.azimuth, CouplingLattice::azimuth);
  const auto [p, y] = split(w.difference, CouplingLattice::difference);
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const int a = corner & 1, b = corner >> 1 & 1, c = corner >> 2;
    const int node = (p + c) * CouplingLattice::plane + CouplingLattice::index(m + a, n + b);
    const double weight = (a == 1 ? x : 1 - x) * (b == 1 ? z : 1 - z) * (c == 1 ? y : 1 - y);
    sum += weight * static_cast<double>(tables.coupling[static_cast<std::size_t>(node * kMostComponents + component)]);
  }
  return sum;
}

}  // namespace

PackedCoefficients pack(const RefinedLayout& layout, int components, int bits,
                        const std::vector<double>& coefficients) {
  PackedCoefficients packed{.bits = bits};
  packed.levels.resize(coefficients.size());
  for (const RefinedPart part : kRefinedParts) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    const auto for_each = [&](auto&& action) {
      for (int k = 0; k < components; ++k) {
        for (int i = 0; i < layout.count(k, part); ++i) action(static_cast<std::size_t>(layout.first(k, part) + i));
      }
    };
    for_each([&](std::size_t i) {
      low = std::min(low, coefficients[i]);
      high = std::max(high, coefficients[i]);
    });
    if (!(low <= high)) continue;
    const auto index = static_cast<std::size_t>(part);
    const double steps = std::exp2(bits) - 1;
    packed.lowest[index] = static_cast<float>(low);
    packed.step[index] = static_cast<float>((high - low) / steps);
    const auto lowest = static_cast<double>(packed.lowest[index]), step = static_cast<double>(packed.step[index]);
    for_each([&](std::size_t i) {
      const double level = step > 0 ? std::round((coefficients[i] - lowest) / step) : 0.0;
      packed.levels[i] = static_cast<std::uint16_t>(std::clamp(level, 0.0, steps));
    });
  }
  return packed;
}

RefinedBrdf::RefinedBrdf(const RefinedStructure& structure, std::vector<FamilyInfo> families,
                         PackedCoefficients coefficients)
    : structure_(structure),
      families_(std::move(families)),
      packed_(std::move(coefficients)),
      layout_((require_structure(structure), structure), coupled(families_)),
      tables_{.half = structure.half,
              .difference = structure.difference,
              .colour_half = structure.colour_half,
              .colour_difference = structure.colour_difference,
              .azimuth = structure.azimuth,
              .azimuth_difference = structure.azimuth_difference,
              .width = static_cast<float>(structure.width)} {
  constexpr int kFewestBits = 6, kMostBits = 16;
  const auto refuse = [](const std::string& what) { throw std::invalid_argument("refined model: " + what); };
  if (families_.size() != static_cast<std::size_t>(structure.components)) {
    refuse(std::to_string(families_.size()) + " families for " + std::to_string(structure.components) + " components");
  }
  if (packed_.bits < kFewestBits || packed_.bits > kMostBits) {
    refuse("bits is " + std::to_string(packed_.bits) + ", allowed are 6 to 16");
  }
  if (packed_.levels.size() != static_cast<std::size_t>(layout_.size())) {
    refuse(std::to_string(packed_.levels.size()) + " coefficients, expected " + std::to_string(layout_.size()));
  }
  for (const std::uint16_t level : packed_.levels) {
    if (level >> packed_.bits != 0) refuse("level " + std::to_string(level) + " does not fit the bits");
  }
  for (std::size_t i = 0; i < kRefinedParts.size(); ++i) {
    if (!std::isfinite(packed_.lowest[i]) || !std::isfinite(packed_.step[i]) || packed_.step[i] < 0) {
      refuse("a range that is not finite");
    }
  }
  tables_.shape.assign(static_cast<std::size_t>(structure.half * structure.difference) * kMostComponents, kAbsent);
  for (int k = 0; k < structure.components; ++k) expand_component(k);
  require_bounded();
}

std::vector<double> RefinedBrdf::part(int component, RefinedPart part) const {
  std::vector<double> values;
  const auto index = static_cast<std::size_t>(part);
  for (int i = 0; i < layout_.count(component, part); ++i) {
    const auto level =
        static_cast<double>(packed_.levels[static_cast<std::size_t>(layout_.first(component, part) + i)]);
    const double value = static_cast<double>(packed_.lowest[index]) + level * static_cast<double>(packed_.step[index]);
    values.push_back(static_cast<double>(static_cast<float>(value)));
  }
  return values;
}

void RefinedBrdf::expand_component(int component) {
  const std::vector<double> shape = part(component, RefinedPart::shape);
  const std::vector<double> azimuth = part(component, RefinedPart::azimuth);
  interleave(shape, component, tables_.shape);
  interleave(part(component, RefinedPart::red), component, tables_.red);
  interleave(part(component, RefinedPart::blue), component, tables_.blue);
  interleave(powers_of(structure_, azimuth), component, tables_.powers);
  const FamilyInfo& family = families_[static_cast<std::size_t>(component)];
  if (family.parameters.empty()) return;
  const CouplingValues log_c =
      Coupling(family).values(coupling_input(structure_, shape, azimuth, part(component, RefinedPart::coupling)));
  interleave(std::vector<double>(log_c.data(), log_c.data() + log_c.size()), component, tables_.coupling);
}

void RefinedBrdf::require_bounded() const {
  constexpr int kNodes = 65;
  const Eigen::ArrayXd nodes = Eigen::ArrayXd::LinSpaced(kNodes, 0, 1);
  const auto spline = [&](int k, RefinedPart which, int rows) {
    const std::vector<double> values = part(k, which);
    const auto columns = rows > 0 ? static_cast<int>(values.size()) / rows : 0;
    const Eigen::Map<const Eigen::MatrixXd> matrix(values.data(), rows, columns);
    const Eigen::MatrixXd across = which == RefinedPart::azimuth
                                       ? Eigen::MatrixXd(Eigen::MatrixXd::Identity(rows, rows))
                                       : spline_basis(nodes, rows);
    return Eigen::MatrixXd(across * matrix * spline_basis(nodes, columns).transpose());
  };
  double bound = 0;
  for (int k = 0; k < structure_.components; ++k) {
    const Eigen::ArrayXXd colour = spline(k, RefinedPart::red, structure_.colour_half)
                                       .cwiseMax(spline(k, RefinedPart::blue, structure_.colour_half))
                                       .cwiseMax(0.0);
    Eigen::ArrayXXd log_value = spline(k, RefinedPart::shape, structure_.half).array() + colour;
    if (structure_.azimuth > 0) {
      const Eigen::MatrixXd azimuth = spline(k, RefinedPart::azimuth, structure_.azimuth);
      log_value.rowwise() += azimuth.colwise().maxCoeff().array().max(0.0);
    }
    bound = std::max(bound, log_value.maxCoeff());
  }
  if (!tables_.coupling.empty()) {
    bound += static_cast<double>(*std::max_element(tables_.coupling.begin(), tables_.coupling.end()));
  }
  if (!(bound <= kLargestLog)) {
    throw std::domain_error("refined model: log f_r may reach " + to_text(bound) + ", allowed are at most " +
                            to_text(kLargestLog));
  }
}

Rgb RefinedBrdf::eval(const Vec3& wo, const Vec3& wi) const {
  if (!(wo.z() > 0 && wi.z() > 0)) return Rgb::Zero();
  Rgb result;
  evaluate_refined(tables_, {wo.data(), 1}, {wi.data(), 1}, 1, result.data(), 1);
  return result;
}

void RefinedBrdf::eval_batch(const DirectionsRef& wo, const DirectionsRef& wi, Eigen::Ref<RgbRows> out) const {
  evaluate_refined(tables_, {wo.data(), wo.outerStride()}, {wi.data(), wi.outerStride()}, out.rows(), out.data(),
                   out.outerStride());
  const auto above = wo.col(2) > 0 && wi.col(2) > 0;
  for (Eigen::Index row = 0; row < out.rows(); ++row) {
    if (!above(row)) out.row(row).setZero();
  }
}

std::size_t refined_bytes(std::size_t components, int bits, std::size_t coefficients) {
  constexpr std::size_t kStructure = 8 + sizeof(float) + 1;  // eight counts, the width, the bits
  constexpr std::size_t kRanges = 2 * sizeof(float) * kRefinedParts.size();
  return kStructure + kRanges + components + (coefficients * static_cast<std::size_t>(bits) + 7) / 8;
}

std::size_t RefinedBrdf::bytes() const {
  return refined_bytes(families_.size(), packed_.bits, packed_.levels.size());
}

std::size_t RefinedBrdf::expanded_bytes() const {
  return sizeof(float) * (tables_.shape.size() + tables_.red.size() + tables_.blue.size() + tables_.powers.size() +
                          tables_.coupling.size());
}

Rgb RefinedBrdf::at(const Warped& w) const {
  const SplineWeights half = spline_weights(w.half, structure_.half);
  const SplineWeights difference = spline_weights(w.difference, structure_.difference);
  const SplineWeights colour_half = spline_weights(w.half, structure_.colour_half);
  const SplineWeights colour_difference = spline_weights(w.difference, structure_.colour_difference);
  const SplineWeights along = spline_weights(w.difference, structure_.azimuth_difference);
  Rgb sum = Rgb::Zero();
  for (int k = 0; k < structure_.components; ++k) {
    double log_green = tensor(part(k, RefinedPart::shape), structure_.half, half, difference);
    const std::vector<double> powers = powers_of(structure_, part(k, RefinedPart::azimuth));
    double azimuth = 0;
    for (int m = structure_.azimuth - 1; m >= 0; --m) {
      for (int j = 0; j < kSplineOrder; ++j) {
        azimuth += along.weight[static_cast<std::size_t>(j)] *
                   powers[static_cast<std::size_t>((along.first + j) * structure_.azimuth + m)];
      }
      azimuth *= w.azimuth;
    }
    log_green += azimuth;
    if (!tables_.coupling.empty()) log_green += lattice(tables_, k, w);
    const auto colour = [&](RefinedPart channel) {
      return tensor(part(k, channel), structure_.colour_half, colour_half, colour_difference);
    };
    sum += Rgb(log_green + colour(RefinedPart::red), log_green, log_green + colour(RefinedPart::blue)).exp();
  }
  return sum;
}

double RefinedBrdf::tau(int component, double theta_d) const {
  const FamilyInfo& family = families_.at(static_cast<std::size_t>(component));
  if (family.parameters.empty()) return 0;
  const std::vector<double> values = part(component, RefinedPart::coupling);
  const SplineWeights weights = spline_weights(1 - std::sqrt(1 - std::sin(theta_d)), structure_.coupling_difference);
  double dependence = 0;
  for (std::size_t j = 0; j < kSplineOrder; ++j) {
    dependence += weights.weight[j] * values[static_cast<std::size_t>(weights.first) + j];
  }
  return Coupling(family).tau(dependence);
}

}  // namespace sklar::brdf
