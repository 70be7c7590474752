#include "brdf/study/energy.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "brdf/model/spline.hpp"
#include "brdf/model/warp.hpp"
#include "brdf/study/albedo.hpp"
#include "copula/error.hpp"

namespace sklar::brdf {
namespace {

constexpr HemisphereOptions kNodes = {.polar = 96, .azimuth = 64};

struct Worst {
  double albedo, theta_o;
  Eigen::Index channel;
};

Worst worst_of(const RefinedBrdf& model) {
  constexpr int kAngles = 180;
  const Eigen::ArrayXd angles = Eigen::ArrayXd::LinSpaced(kAngles, 0, 89.5) * (std::numbers::pi / 180);
  const AlbedoCurve curve = directional_albedo(model, angles, kNodes);
  Eigen::Index row = 0, channel = 0;
  const double albedo = curve.albedo.maxCoeff(&row, &channel);
  return {albedo, angles(row), channel};
}

/// Derivatives of the log of an albedo by the spline coefficients of a log factor of theta_d.
Eigen::ArrayXd shares_of(const RefinedBrdf& model, const Worst& worst) {
  const HemisphereNodes nodes = hemisphere_nodes(worst.theta_o, kNodes);
  Directions wo(nodes.wi.rows(), 3);
  wo.rowwise() = Eigen::Array<double, 1, 3>(std::sin(worst.theta_o), 0, std::cos(worst.theta_o));
  const Eigen::ArrayXd light = model.eval(wo, nodes.wi).col(worst.channel) * nodes.weight;
  const RefinedStructure& structure = model.structure();
  Eigen::ArrayXd shares = Eigen::ArrayXd::Zero(structure.difference);
  for (Eigen::Index i = 0; i < light.size(); ++i) {
    const Warped w = warp(structure.width, wo.row(i), nodes.wi.row(i));
    const SplineWeights weights = spline_weights(w.difference, structure.difference);
    for (int j = 0; j < kSplineOrder; ++j) {
      shares(weights.first + j) += weights.weight[static_cast<std::size_t>(j)] * light(i);
    }
  }
  return shares / light.sum();
}

std::shared_ptr<const RefinedBrdf> lowered(const RefinedBrdf& model, const Eigen::ArrayXd& log_factor) {
  const RefinedStructure& structure = model.structure();
  std::vector<double> x = unpack(model.layout(), model.coefficients());
  for (int k = 0; k < structure.components; ++k) {
    for (int i = 0; i < model.layout().count(k, RefinedPart::shape); ++i) {
      x[static_cast<std::size_t>(model.layout().first(k, RefinedPart::shape) + i)] += log_factor(i / structure.half);
    }
  }
  return std::make_shared<RefinedBrdf>(structure, model.families(), pack(model.layout(), model.coefficients().bits, x));
}

}  // namespace

LimitedBrdf limit_albedo(const std::shared_ptr<const RefinedBrdf>& model, double limit) {
  if (!(limit > 0)) {
    throw std::invalid_argument("limit_albedo: the limit is " + to_text(limit) + ", it must be positive");
  }
  constexpr int kSteps = 200;
  constexpr double kMargin = 1e-3;  // of a step beyond the limit, for what the rounding of coefficients adds
  Worst worst = worst_of(*model);
  LimitedBrdf result{.brdf = model, .albedo_before = worst.albedo, .albedo_after = worst.albedo};
  Eigen::ArrayXd log_factor = Eigen::ArrayXd::Zero(model->structure().difference);
  for (int step = 0; step < kSteps && worst.albedo > limit; ++step) {
    const Eigen::ArrayXd shares = shares_of(*result.brdf, worst);
    log_factor -= (std::log(worst.albedo / limit) + kMargin) / shares.square().sum() * shares;
    result.brdf = lowered(*model, log_factor);
    worst = worst_of(*result.brdf);
    result.albedo_after = worst.albedo;
  }
  result.lowest_factor = std::exp(log_factor.minCoeff());
  if (worst.albedo > limit) {
    throw std::runtime_error("limit_albedo: the albedo is still " + to_text(worst.albedo) + " after " +
                             std::to_string(kSteps) + " steps");
  }
  return result;
}

}  // namespace sklar::brdf
