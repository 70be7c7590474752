#include "brdf/model/anisotropic_structure.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include "brdf/model/spline.hpp"

namespace sklar::brdf {
namespace {

void require_count(const char* field, int value, int lowest, int highest) {
  if (value >= lowest && value <= highest) return;
  throw std::invalid_argument("anisotropic model: " + std::string(field) + " is " + std::to_string(value) +
                              ", allowed are " + std::to_string(lowest) + " to " + std::to_string(highest));
}

}  // namespace

void require_structure(const AnisotropicStructure& structure) {
  constexpr int kMost = 64, kHighestDegree = 6, kMostHarmonics = 2;
  require_count("components", structure.components, 1, kMostAnisotropicComponents);
  require_count("half", structure.half, kSplineOrder, kMost);
  require_count("difference", structure.difference, kSplineOrder, kMost);
  require_count("colour_half", structure.colour_half, 0, kHighestDegree);
  require_count("colour_difference", structure.colour_difference, 0, kHighestDegree);
  require_count("azimuth", structure.azimuth, 0, kHighestDegree);
  require_count("azimuth_difference", structure.azimuth_difference, 0, kHighestDegree);
  require_count("masking", structure.masking, 0, kHighestDegree);
  require_count("masking_harmonics", structure.masking_harmonics, 0, kMostHarmonics);
  require_count("half_harmonics", structure.half_harmonics, 0, kMostHarmonics);
  require_count("half_harmonics_degree", structure.half_harmonics_degree, 0, kHighestDegree);
}

std::vector<TermGroup> term_groups(const AnisotropicStructure& s) {
  std::vector<TermGroup> groups = {{s.azimuth * (s.azimuth_difference + 1), false}};
  groups.push_back({s.masking, false});
  for (int m = 0; m < 2 * s.masking_harmonics; ++m) groups.push_back({s.masking + 1, true});
  for (int m = 0; m < 2 * s.half_harmonics; ++m) groups.push_back({s.half_harmonics_degree + 1, true});
  return groups;
}

int shared_terms(const AnisotropicStructure& s) {
  int count = 0;
  for (const TermGroup& group : term_groups(s)) count += group.count;
  return count;
}

int colour_terms(const AnisotropicStructure& s) {
  return (s.colour_half + 1) * (s.colour_difference + 1);
}

AnisotropicLayout::AnisotropicLayout(const AnisotropicStructure& structure)
    : components_(structure.components),
      count_{structure.half * structure.difference, shared_terms(structure), colour_terms(structure),
             colour_terms(structure), structure.tilted ? 5 : 3} {
  for (std::size_t part = 0; part < count_.size(); ++part) {
    first_[part] = stride_;
    stride_ += count_[part];
  }
}

std::vector<CoefficientRun> AnisotropicLayout::runs(int bits) const {
  std::vector<CoefficientRun> result;
  for (int k = 0; k < components_; ++k) {
    for (const AnisotropicPart part : kAnisotropicParts) {
      result.push_back({.part = static_cast<std::size_t>(part),
                        .first = static_cast<std::size_t>(first(k, part)),
                        .count = static_cast<std::size_t>(count(part)),
                        .bits = part == AnisotropicPart::metric ? kMetricBits : bits});
    }
  }
  return result;
}

namespace {

/// cosh(r), sinh(r) / r and the derivative of the latter by r, over r.
struct Hyperbolic {
  double even, odd, odd_slope;

  explicit Hyperbolic(double r) {
    constexpr double kSmall = 1e-2;  // below it the terms left out are less than 1e-12
    even = std::cosh(r);
    const double square = r * r;
    odd = r > kSmall ? std::sinh(r) / r : 1 + square / 6 * (1 + square / 20);
    odd_slope = r > kSmall ? (even - odd) / square : 1.0 / 3 + square / 30 * (1 + square / 28);
  }
};

}  // namespace

Metric Metric::from(const double* c, bool tilted) {
  const Hyperbolic h(std::hypot(c[1], c[2]));
  const double scale = std::exp(c[0]);
  return {.xx = scale * (h.even + h.odd * c[1]),
          .xy = scale * h.odd * c[2],
          .yy = scale * (h.even - h.odd * c[1]),
          .x = tilted ? c[3] : 0,
          .y = tilted ? c[4] : 0};
}

double Metric::half(double h_x, double h_y, double h_z) const {
  const double u = h_x - x * h_z, v = h_y - y * h_z;
  const double root = std::sqrt(std::sqrt(xx * u * u + 2 * xy * u * v + yy * v * v));
  return root / (root + std::sqrt(h_z));
}

void Metric::pull_back(const double* c, bool tilted, const std::array<double, 5>& by, double* gradient) {
  const Metric m = from(c, tilted);
  const Hyperbolic h(std::hypot(c[1], c[2]));
  const double scale = std::exp(c[0]);
  const double trace = by[0] + by[2], across = by[0] - by[2];
  // d even = odd r dr, d odd = odd_slope r dr.
  const double radial = scale * (trace * h.odd + (across * c[1] + by[1] * c[2]) * h.odd_slope);
  gradient[0] = by[0] * m.xx + by[1] * m.xy + by[2] * m.yy;
  gradient[1] = radial * c[1] + scale * h.odd * across;
  gradient[2] = radial * c[2] + scale * h.odd * by[1];
  if (!tilted) return;
  gradient[3] = by[3];
  gradient[4] = by[4];
}

}  // namespace sklar::brdf
