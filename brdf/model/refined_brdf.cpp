#include "brdf/model/refined_brdf.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <stdexcept>

#include "brdf/model/coupling.hpp"
#include "brdf/model/lattice.hpp"
#include "brdf/model/spline.hpp"
#include "copula/error.hpp"

namespace sklar::brdf {
namespace {

constexpr double kLargestLog = 80;  // of f_r; e^80 is within single precision
constexpr float kAbsent = -80;      // the log density of a component that is not there

/// Puts numbers of a component into a table in the order of the kernel.
void interleave(const Eigen::Ref<const Eigen::MatrixXd>& values, std::size_t first, std::size_t step,
                AlignedFloats& table) {
  for (Eigen::Index j = 0; j < values.cols(); ++j) {
    for (Eigen::Index i = 0; i < values.rows(); ++i, first += step) table[first] = static_cast<float>(values(i, j));
  }
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

/// Of two neighbours on an axis.
double mixed(const Between& between, const std::function<double(int)>& at) {
  return (1 - between.share) * at(between.low) + between.share * at(between.high);
}

}  // namespace

RefinedBrdf::RefinedBrdf(const RefinedStructure& structure, std::vector<FamilyInfo> families,
                         PackedCoefficients coefficients)
    : structure_(structure),
      families_(std::move(families)),
      packed_(std::move(coefficients)),
      layout_((require_structure(structure), structure), coupled(families_)),
      tables_{.half = structure.half,
              .difference = structure.difference,
              .powers_pairs = (structure.azimuth + 1) / 2,
              .width = static_cast<float>(structure.width),
              .on_part = !is_whole(structure),
              .half_axis = PlacedAxis(structure.half_range),
              .difference_axis = PlacedAxis(structure.difference_range)} {
  if (families_.size() != static_cast<std::size_t>(structure.components)) {
    throw std::invalid_argument("refined model: " + std::to_string(families_.size()) + " families for " +
                                std::to_string(structure.components) + " components");
  }
  require_packed("refined model", layout_.runs(packed_.bits), packed_);
  unpacked_ = unpack(layout_, packed_);
  expand();
  require_bounded();
}

std::vector<double> RefinedBrdf::part(int component, RefinedPart part) const {
  const auto first = unpacked_.begin() + layout_.first(component, part);
  return {first, first + layout_.count(component, part)};
}

void RefinedBrdf::expand() {
  constexpr auto kMost = static_cast<std::size_t>(kMostComponents);
  constexpr auto kColours = 2 * kMost * Lattice::half * Lattice::difference;
  tables_.shape.assign(static_cast<std::size_t>(structure_.half * structure_.difference) * kMost, kAbsent);
  tables_.colour.assign(kColours, 0);
  tables_.powers.assign(static_cast<std::size_t>(even_azimuth()) * kMost * Lattice::difference, 0);
  const std::vector<bool> copulas = coupled(families_);
  if (std::find(copulas.begin(), copulas.end(), true) != copulas.end()) {
    tables_.coupling.assign(kMost * Lattice::plane * Lattice::difference, 0);
  }
  for (int k = 0; k < structure_.components; ++k) expand_component(k);
}

void RefinedBrdf::expand_component(int component) {
  using Matrix = Eigen::MatrixXd;
  using MatrixIn = Eigen::Map<const Matrix>;
  constexpr auto kMost = static_cast<std::size_t>(kMostComponents);
  const auto k = static_cast<std::size_t>(component);
  const std::vector<double> shape = part(component, RefinedPart::shape);
  interleave(MatrixIn(shape.data(), structure_.half, structure_.difference), k, kMost, tables_.shape);

  const Eigen::ArrayXd half = Eigen::ArrayXd::LinSpaced(Lattice::half, 0, 1);
  const Eigen::ArrayXd difference = Eigen::ArrayXd::LinSpaced(Lattice::difference, 0, 1);
  const auto colour = [&](RefinedPart channel, std::size_t first) {
    const std::vector<double> values = part(component, channel);
    const MatrixIn logs(values.data(), structure_.colour_half, structure_.colour_difference);
    const Matrix at_nodes = spline_basis(half, structure_.colour_half) * logs *
                            spline_basis(difference, structure_.colour_difference).transpose();
    interleave(at_nodes.array().exp(), first, 2 * kMost, tables_.colour);
  };
  colour(RefinedPart::red, k);
  colour(RefinedPart::blue, kMost + k);

  const std::vector<double> azimuth = part(component, RefinedPart::azimuth);
  Matrix powers = Matrix::Zero(even_azimuth(), Lattice::difference);
  powers.topRows(structure_.azimuth) = azimuth_powers(structure_.azimuth) *
                                       MatrixIn(azimuth.data(), structure_.azimuth, structure_.azimuth_difference) *
                                       spline_basis(difference, structure_.azimuth_difference).transpose();
  interleave(powers, k, kMost, tables_.powers);

  const FamilyInfo& family = families_[k];
  if (family.parameters.empty()) return;
  const CouplingValues log_c =
      Coupling(family).values(coupling_input(structure_, shape, azimuth, part(component, RefinedPart::coupling)));
  interleave(log_c, k, kMost, tables_.coupling);
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
  Rgb result;
  evaluate_refined(tables_, {wo.data(), 1}, {wi.data(), 1}, 1, result.data(), 1);
  return result;
}

void RefinedBrdf::eval_batch(const DirectionsRef& wo, const DirectionsRef& wi, Eigen::Ref<RgbRows> out) const {
  evaluate_refined(tables_, {wo.data(), wo.outerStride()}, {wi.data(), wi.outerStride()}, out.rows(), out.data(),
                   out.outerStride());
}

std::size_t refined_bytes(const RefinedStructure& structure, const RefinedLayout& layout, int bits) {
  constexpr std::size_t kStructure = 8 + sizeof(float) + 1;  // eight counts, the width, the bits; then four ends
  constexpr std::size_t kRanges = 2 * sizeof(float) * kRefinedParts.size();
  return kStructure + (is_whole(structure) ? 0 : 4) + kRanges + static_cast<std::size_t>(layout.components()) +
         packed_bytes(layout.runs(bits));
}

std::size_t RefinedBrdf::bytes() const {
  return refined_bytes(structure_, layout_, packed_.bits);
}

std::size_t RefinedBrdf::expanded_bytes() const {
  return sizeof(float) *
         (tables_.shape.size() + tables_.colour.size() + tables_.powers.size() + tables_.coupling.size());
}

Rgb RefinedBrdf::at(const Warped& w) const {
  const SplineWeights half = spline_weights(w.half, structure_.half);
  const SplineWeights difference = spline_weights(w.difference, structure_.difference);
  const Between h = on_lattice(w.half, Lattice::half), p = on_lattice(w.difference, Lattice::difference),
                n = on_lattice(w.azimuth, Lattice::azimuth);
  Rgb sum = Rgb::Zero();
  for (int k = 0; k < structure_.components; ++k) {
    const auto entry = [&](const AlignedFloats& table, int index) {
      return static_cast<double>(table[static_cast<std::size_t>(index * kMostComponents + k)]);
    };
    double log_green = tensor(part(k, RefinedPart::shape), structure_.half, half, difference);
    double azimuth = 0;
    for (int m = structure_.azimuth; m-- > 0;) {
      azimuth *= w.azimuth - 0.5;
      azimuth += mixed(p, [&](int row) { return entry(tables_.powers, row * even_azimuth() + m); });
    }
    log_green += azimuth * w.azimuth;
    if (!tables_.coupling.empty()) {
      log_green += mixed(p, [&](int plane) {
        return mixed(h, [&](int row) {
          return mixed(n, [&](int column) {
            return entry(tables_.coupling, plane * Lattice::plane + Lattice::index(row, column));
          });
        });
      });
    }
    const auto colour = [&](int channel) {
      return mixed(p, [&](int column) {
        return mixed(h, [&](int row) { return entry(tables_.colour, 2 * (column * Lattice::half + row) + channel); });
      });
    };
    sum += std::exp(log_green) * Rgb(colour(0), 1, colour(1));
  }
  return sum;
}

double RefinedBrdf::tau(int component, double theta_d) const {
  const FamilyInfo& family = families_.at(static_cast<std::size_t>(component));
  if (family.parameters.empty()) return 0;
  const std::vector<double> values = part(component, RefinedPart::coupling);
  const double difference = structure_.difference_range.place(1 - std::sqrt(1 - std::sin(theta_d)));
  const SplineWeights weights = spline_weights(difference, structure_.coupling_difference);
  double dependence = 0;
  for (std::size_t j = 0; j < kSplineOrder; ++j) {
    dependence += weights.weight[j] * values[static_cast<std::size_t>(weights.first) + j];
  }
  return Coupling(family).tau(dependence);
}

}  // namespace sklar::brdf
