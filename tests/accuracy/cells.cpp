#include "tests/accuracy/cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace sklar::accuracy {
namespace {

double uniform(Rng& rng, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(rng);
}

double log_uniform(Rng& rng, double low, double high) {
  return std::pow(10.0, uniform(rng, low, high));
}

double random_theta(const Interval& domain, double largest, Rng& rng) {
  for (;;) {
    double theta = 0;
    switch (rng() % 4) {
      case 0:
        theta = domain.lowest + log_uniform(rng, -10, 4);
        break;
      case 1:
        theta = domain.highest - log_uniform(rng, -15, 0);
        break;
      case 2:
        theta = log_uniform(rng, -10, 4);
        break;
      default:
        theta = -log_uniform(rng, -10, 4);
    }
    if (std::abs(theta) <= largest && domain.contains(theta)) return theta;
  }
}

double random_coordinate(const std::vector<double>& others, Rng& rng) {
  for (;;) {
    double u = 0;
    switch (rng() % 8) {
      case 0:
        u = log_uniform(rng, -300, 0);
        break;
      case 1:
        u = log_uniform(rng, -16, 0);
        break;
      case 2:
        u = 1 - log_uniform(rng, -16, 0);
        break;
      case 3:
        u = others.empty() ? 0.5 : others[rng() % others.size()];
        break;
      case 4:
        u = others.empty() ? 0.5 : others[rng() % others.size()] * (1 - log_uniform(rng, -16, -1));
        break;
      default:
        u = uniform(rng, 0, 1);
    }
    if (u > 0 && u < 1) return u;
  }
}

}  // namespace

const char* to_text(Quantity quantity) {
  constexpr std::array<const char*, kQuantities> kNames = {"log_pdf", "log_cdf", "h",
                                                           "h_upper", "h_inv",   "h_inv_upper"};
  return kNames[static_cast<std::size_t>(quantity)];
}

Cell random_cell(const FamilyInfo& family, int dim, double largest, Rng& rng) {
  Cell cell{static_cast<Quantity>(rng() % kQuantities), {}, {}};
  for (const ParameterInfo& parameter : family.parameters) {
    cell.theta.push_back(random_theta(parameter.domain(dim), largest, rng));
  }
  for (int k = 0; k < dim; ++k) cell.u.push_back(random_coordinate(cell.u, rng));
  return cell;
}

std::string region(const FamilyInfo& family, const Cell& cell) {
  constexpr double kEdge = 1e-6, kWeak = 0.01, kStrong = 0.95;
  const double tau = std::abs(family.tau(cell.theta));
  const bool theta = !family.parameters.empty() && !(tau >= kWeak && tau <= kStrong);
  const bool u = std::any_of(cell.u.begin(), cell.u.end(), [](double x) { return x < kEdge || x > 1 - kEdge; });
  if (theta && u) return "both";
  return theta ? "theta" : u ? "u" : "ordinary";
}

}  // namespace sklar::accuracy
