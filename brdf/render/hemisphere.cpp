#include "brdf/render/hemisphere.hpp"

#include <boost/math/special_functions/legendre.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "copula/error.hpp"

namespace sklar::brdf {
namespace {

struct Rule {
  std::vector<double> node, weight;
};

/// Gauss-Legendre on [0,1].
Rule gauss_legendre(int count) {
  Rule rule;
  const auto add = [&](double x) {
    const double slope = boost::math::legendre_p_prime(count, x);
    rule.node.push_back((1 + x) / 2);
    rule.weight.push_back(1 / ((1 - x * x) * slope * slope));
  };
  for (const double zero : boost::math::legendre_p_zeros<double>(count)) {  // the ones >= 0
    add(zero);
    if (zero != 0) add(-zero);
  }
  return rule;
}

}  // namespace

HemisphereNodes hemisphere_nodes(double theta_o, const HemisphereOptions& options) {
  using std::numbers::pi;
  if (!(theta_o >= 0 && theta_o < pi / 2)) {
    throw std::domain_error("hemisphere_nodes: theta_o must be in [0, pi/2), got " + to_text(theta_o));
  }
  if (options.polar < 2 || options.azimuth < 2) {
    throw std::invalid_argument("hemisphere_nodes: polar and azimuth must be at least 2, got " +
                                std::to_string(options.polar) + " and " + std::to_string(options.azimuth));
  }
  const Rule rule = gauss_legendre(options.polar);
  const double step = 2 * pi / options.azimuth;
  const Vec3 wo(std::sin(theta_o), 0, std::cos(theta_o));
  HemisphereNodes nodes{Directions(options.polar * options.azimuth, 3),
                        Eigen::ArrayXd(options.polar * options.azimuth)};
  Eigen::Index row = 0;
  for (int k = 0; k < options.azimuth; ++k) {
    const double phi = (k + 0.5) * step;
    const double horizon = (pi / 2 + std::atan2(wo.x() * std::cos(phi), wo.z())) / 2;
    for (std::size_t j = 0; j < rule.node.size(); ++j, ++row) {
      const double s = rule.node[j];
      const double theta_h = horizon * s * s * s;
      const double sine = std::sin(theta_h);
      const Vec3 half(sine * std::cos(phi), sine * std::sin(phi), std::cos(theta_h));
      const double cosine = wo.dot(half);
      const Vec3 wi = (2 * cosine * half - wo).normalized();
      nodes.wi.row(row) = wi.transpose().array();
      nodes.weight(row) = wi.z() * 4 * cosine * sine * 3 * horizon * s * s * rule.weight[j] * step;
    }
  }
  return nodes;
}

}  // namespace sklar::brdf
