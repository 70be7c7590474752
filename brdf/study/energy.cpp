#include "brdf/study/energy.hpp"

#include <tbb/parallel_for.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "brdf/model/spline.hpp"
#include "brdf/model/warp.hpp"
#include "brdf/render/hemisphere.hpp"
#include "copula/error.hpp"

namespace sklar::brdf {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// A direction in which light leaves, in radians.
struct View {
  double theta, phi;
};

struct Quadrature {
  Directions wo, wi;
  Eigen::ArrayXd weight;
};

/// Where the albedo of a kind of model is taken: counts of theta_o and phi_o, the step of theta_o in degrees.
template <class Model>
struct Views;
template <>
struct Views<RefinedBrdf> {
  static constexpr HemisphereOptions nodes = {.polar = 96, .azimuth = 64};
  static constexpr int polar = 180, azimuths = 1;
  static constexpr double step = 0.5;
};
template <>
struct Views<AnisotropicModel> {
  static constexpr HemisphereOptions nodes = {.polar = 48, .azimuth = 48};
  static constexpr int polar = 30, azimuths = 24;
  static constexpr double step = 3;
};

Quadrature quadrature_at(const View& view, const HemisphereOptions& options) {
  const HemisphereNodes nodes = hemisphere_nodes(view.theta, options);
  const double c = std::cos(view.phi), s = std::sin(view.phi), sine = std::sin(view.theta);
  Quadrature result{Directions(nodes.wi.rows(), 3), Directions(nodes.wi.rows(), 3), nodes.weight};
  result.wo.rowwise() = Eigen::Array<double, 1, 3>(sine * c, sine * s, std::cos(view.theta));
  result.wi << c * nodes.wi.col(0) - s * nodes.wi.col(1), s * nodes.wi.col(0) + c * nodes.wi.col(1), nodes.wi.col(2);
  return result;
}

struct Worst {
  double albedo;
  View view;
  Eigen::Index channel;
};

template <class Model>
Worst worst_of(const Model& model) {
  using V = Views<Model>;
  const auto view_at = [](Eigen::Index row) {
    const Eigen::Index polar = row / V::azimuths;
    return View{static_cast<double>(polar) * V::step * kDegree,
                static_cast<double>(row % V::azimuths) * (360 * kDegree / V::azimuths)};
  };
  RgbRows albedo(V::polar * V::azimuths, 3);
  tbb::parallel_for(Eigen::Index{0}, albedo.rows(), [&](Eigen::Index row) {
    const Quadrature q = quadrature_at(view_at(row), V::nodes);
    albedo.row(row) = (model.eval(q.wo, q.wi).colwise() * q.weight).colwise().sum();
  });
  Eigen::Index row = 0, channel = 0;
  const double largest = albedo.maxCoeff(&row, &channel);
  return {largest, view_at(row), channel};
}

double difference_of(const RefinedBrdf& model, const Vec3& wo, const Vec3& wi) {
  return coordinates(model.structure(), wo, wi).difference;
}
double difference_of(const AnisotropicModel&, const Vec3& wo, const Vec3& wi) {
  constexpr double kAnyWidth = 1;  // difference does not depend on it
  return warp(kAnyWidth, wo, wi).difference;
}

/// Derivatives of the log of an albedo by the spline coefficients of a log factor of theta_d.
template <class Model>
Eigen::ArrayXd shares_of(const Model& model, const Worst& worst) {
  const Quadrature q = quadrature_at(worst.view, Views<Model>::nodes);
  const Eigen::ArrayXd light = model.eval(q.wo, q.wi).col(worst.channel) * q.weight;
  const int count = model.structure().difference;
  Eigen::ArrayXd shares = Eigen::ArrayXd::Zero(count);
  for (Eigen::Index i = 0; i < light.size(); ++i) {
    const SplineWeights weights = spline_weights(difference_of(model, q.wo.row(i), q.wi.row(i)), count);
    for (int j = 0; j < kSplineOrder; ++j) {
      shares(weights.first + j) += weights.weight[static_cast<std::size_t>(j)] * light(i);
    }
  }
  return shares / light.sum();
}

/// The coefficients with the log factor added to the shapes, half x difference each.
template <class Layout, class Part>
PackedCoefficients lowered(const Layout& layout, const PackedCoefficients& from, int components, Part shape, int half,
                           const Eigen::ArrayXd& log_factor) {
  std::vector<double> x = unpack(layout, from);
  for (int k = 0; k < components; ++k) {
    const int first = layout.first(k, shape);
    for (int i = 0; i < half * static_cast<int>(log_factor.size()); ++i) {
      x[static_cast<std::size_t>(first + i)] += log_factor(i / half);
    }
  }
  return pack(layout, from.bits, x);
}

std::shared_ptr<const RefinedBrdf> lowered(const RefinedBrdf& model, const Eigen::ArrayXd& log_factor) {
  const RefinedStructure& s = model.structure();
  return std::make_shared<RefinedBrdf>(
      s, model.families(),
      lowered(model.layout(), model.coefficients(), s.components, RefinedPart::shape, s.half, log_factor));
}

std::shared_ptr<const AnisotropicModel> lowered(const AnisotropicModel& model, const Eigen::ArrayXd& log_factor) {
  const AnisotropicStructure& s = model.structure();
  return std::make_shared<AnisotropicModel>(
      s, lowered(AnisotropicLayout(s), model.coefficients(), s.components, AnisotropicPart::shape, s.half, log_factor));
}

template <class Model>
Limited<Model> limited(const std::shared_ptr<const Model>& model, double limit) {
  if (!(limit > 0)) {
    throw std::invalid_argument("limit_albedo: the limit is " + to_text(limit) + ", it must be positive");
  }
  constexpr int kSteps = 200;
  constexpr double kMargin = 1e-3;  // of a step beyond the limit, for what the rounding of coefficients adds
  Worst worst = worst_of(*model);
  Limited<Model> result{.brdf = model, .albedo_before = worst.albedo, .albedo_after = worst.albedo};
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

}  // namespace

Limited<RefinedBrdf> limit_albedo(const std::shared_ptr<const RefinedBrdf>& model, double limit) {
  return limited(model, limit);
}

Limited<AnisotropicModel> limit_albedo(const std::shared_ptr<const AnisotropicModel>& model, double limit) {
  return limited(model, limit);
}

}  // namespace sklar::brdf
