#include "brdf/model/anisotropic_model.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <stdexcept>

#include "copula/error.hpp"

namespace sklar::brdf {
namespace {

constexpr double kLargestLog = 80;  // of f_r; e^80 is within single precision
}  // namespace

std::size_t anisotropic_bytes(const AnisotropicStructure& structure, int bits) {
  constexpr std::size_t kStructure = 11 + 1 + 1;  // counts, the flag, the bits
  constexpr std::size_t kRanges = 2 * sizeof(float) * kAnisotropicParts.size();
  return kStructure + kRanges + packed_bytes(AnisotropicLayout(structure).runs(bits));
}

AnisotropicTables anisotropic_tables(const AnisotropicStructure& structure, const std::vector<double>& coefficients) {
  const AnisotropicLayout layout(structure);
  AnisotropicTables tables{
      .structure = structure, .shared = shared_terms(structure), .colours = colour_terms(structure)};
  for (int k = 0; k < structure.components; ++k) {
    const auto append = [&](AnisotropicPart part, std::vector<float>& to) {
      const auto from = coefficients.begin() + layout.first(k, part);
      std::transform(from, from + layout.count(part), std::back_inserter(to),
                     [](double x) { return static_cast<float>(x); });
    };
    append(AnisotropicPart::shape, tables.shape);
    append(AnisotropicPart::terms, tables.terms);
    append(AnisotropicPart::red, tables.red);
    append(AnisotropicPart::blue, tables.blue);
    const Metric m = Metric::from(coefficients.data() + layout.first(k, AnisotropicPart::metric), structure.tilted);
    for (const double x : {m.xx, m.xy, m.yy, m.x, m.y}) tables.metric.push_back(static_cast<float>(x));
  }
  return tables;
}

AnisotropicModel::AnisotropicModel(const AnisotropicStructure& structure, PackedCoefficients coefficients)
    : structure_((require_structure(structure), structure)),
      packed_((require_packed("anisotropic model", AnisotropicLayout(structure).runs(coefficients.bits), coefficients),
               std::move(coefficients))),
      tables_(anisotropic_tables(structure_, unpack(AnisotropicLayout(structure_), packed_))) {
  const double largest = largest_log();
  if (!(largest <= kLargestLog)) {
    throw std::domain_error("anisotropic model: log f_r may reach " + to_text(largest) + ", allowed are at most " +
                            to_text(kLargestLog));
  }
  for (int k = 0; k < structure.components; ++k) {
    constexpr double kLargest = 1e12, kSteepest = 100;
    const Metric m = metric(k);
    if (!(m.xx + m.yy <= kLargest && m.xx * m.yy - m.xy * m.xy >= 1 / kLargest &&
          std::max(std::abs(m.x), std::abs(m.y)) <= kSteepest)) {
      throw std::domain_error("anisotropic model: the metric of component " + std::to_string(k) + " is out of range");
    }
  }
}

double AnisotropicModel::largest_log() const {
  const std::vector<double> x = unpack(AnisotropicLayout(structure_), packed_);
  const AnisotropicLayout layout(structure_);
  double bound = 0;
  for (int k = 0; k < structure_.components; ++k) {
    const auto largest = [&](AnisotropicPart part, double at_least) {
      const auto first = x.begin() + layout.first(k, part);
      return std::accumulate(first, first + layout.count(part), at_least,
                             [](double a, double b) { return std::max(a, b); });
    };
    double log_value = largest(AnisotropicPart::shape, -kLargestLog);
    log_value += std::max(largest(AnisotropicPart::red, 0), largest(AnisotropicPart::blue, 0));
    auto term = x.begin() + layout.first(k, AnisotropicPart::terms);
    for (const TermGroup& group : term_groups(structure_)) {
      double most = 0;
      for (const auto last = term + group.count; term != last; ++term) {
        most = std::max(most, group.harmonic ? std::abs(*term) : *term);
      }
      log_value += most;
    }
    bound = std::max(bound, log_value);
  }
  return bound;
}

Rgb AnisotropicModel::eval(const Vec3& wo, const Vec3& wi) const {
  if (!(wo.z() > 0 && wi.z() > 0)) return Rgb::Zero();
  Rgb result;
  evaluate_anisotropic(tables_, {wo.data(), 1}, {wi.data(), 1}, 1, result.data(), 1);
  return result;
}

void AnisotropicModel::eval_batch(const DirectionsRef& wo, const DirectionsRef& wi, Eigen::Ref<RgbRows> out) const {
  evaluate_anisotropic(tables_, {wo.data(), wo.outerStride()}, {wi.data(), wi.outerStride()}, out.rows(), out.data(),
                       out.outerStride());
  for (Eigen::Index row = 0; row < out.rows(); ++row) {
    if (!(wo(row, 2) > 0 && wi(row, 2) > 0)) out.row(row).setZero();
  }
}

Metric AnisotropicModel::metric(int component) const {
  const std::vector<double> x = unpack(AnisotropicLayout(structure_), packed_);
  const AnisotropicLayout layout(structure_);
  return Metric::from(x.data() + layout.first(component, AnisotropicPart::metric), structure_.tilted);
}

}  // namespace sklar::brdf
