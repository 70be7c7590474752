#include "brdf/study/energy.hpp"

#include <tbb/parallel_for.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "brdf/data/interpolation.hpp"
#include "brdf/geometry/frame.hpp"
#include "brdf/model/spline.hpp"
#include "brdf/model/warp.hpp"
#include "brdf/render/hemisphere.hpp"
#include "brdf/sampling/drawn_by.hpp"
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

void require_limit(double limit) {
  if (limit > 0) return;
  throw std::invalid_argument("limit_albedo: the limit is " + to_text(limit) + ", it must be positive");
}

template <class Model>
Limited<Model> limited(const std::shared_ptr<const Model>& model, double limit) {
  require_limit(limit);
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

constexpr int kDegrees = 90;

Between degrees_of(const Vec3& w) {
  return between_clamped(polar_angle(w) / kDegree, kDegrees);
}

/// Where the light goes that comes at theta_o = 0, 1, .., 89 degrees: for each of some phi_o the shares of its albedo
/// by degrees of theta_i.
class Reflected {
 public:
  explicit Reflected(const Brdf& brdf) : azimuths_(brdf.traits().isotropic ? 1 : Views<AnisotropicModel>::azimuths) {
    const HemisphereOptions nodes = azimuths_ == 1 ? Views<RefinedBrdf>::nodes : Views<AnisotropicModel>::nodes;
    shares_.assign(static_cast<std::size_t>(kDegrees * azimuths_), RgbRows::Zero(kDegrees, 3));
    tbb::parallel_for(0, kDegrees * azimuths_, [&](int view) {
      const int degree_o = view / azimuths_, azimuth = view % azimuths_;
      const Quadrature q = quadrature_at({degree_o * kDegree, azimuth * (360 * kDegree / azimuths_)}, nodes);
      const RgbRows light = brdf.eval(q.wo, q.wi).colwise() * q.weight;
      RgbRows& shares = shares_[static_cast<std::size_t>(view)];
      for (Eigen::Index row = 0; row < light.rows(); ++row) {
        const Between degree = degrees_of(q.wi.row(row).transpose());
        shares.row(degree.low) += (1 - degree.share) * light.row(row);
        shares.row(degree.high) += degree.share * light.row(row);
      }
    });
  }

  /// The albedo of f_r k(theta_i) k(theta_o), the largest over phi_o. @param k at 0, 1, .., 89 degrees.
  [[nodiscard]] RgbRows albedo(const RgbRows& k) const {
    RgbRows largest = RgbRows::Zero(kDegrees, 3);
    for (std::size_t view = 0; view < shares_.size(); ++view) {
      const auto row = static_cast<Eigen::Index>(view) / azimuths_;
      largest.row(row) = largest.row(row).max((shares_[view] * k).colwise().sum() * k.row(row));
    }
    return largest;
  }

 private:
  int azimuths_;
  std::vector<RgbRows> shares_;
};

/// f_r k(theta_i) k(theta_o).
class Dimmed final : public Brdf {
 public:
  /// @param factor k at 0, 1, .., 89 degrees.
  Dimmed(BrdfPtr brdf, RgbRows factor) : brdf_(std::move(brdf)), factor_(std::move(factor)) {}

  using Brdf::eval;
  [[nodiscard]] Rgb eval(const Vec3& wo, const Vec3& wi) const override {
    return brdf_->eval(wo, wi) * (at(wo) * at(wi));
  }
  [[nodiscard]] Traits traits() const override { return brdf_->traits(); }
  [[nodiscard]] std::size_t bytes() const override {
    return brdf_->bytes() + static_cast<std::size_t>(factor_.size()) * sizeof(double);
  }

 private:
  [[nodiscard]] Rgb at(const Vec3& w) const {
    const Between degree = degrees_of(w);
    return factor_.row(degree.low) + degree.share * (factor_.row(degree.high) - factor_.row(degree.low));
  }

  BrdfPtr brdf_;
  RgbRows factor_;
};

}  // namespace

Limited<Brdf> limit_albedo(const BrdfPtr& brdf, double limit) {
  require_limit(limit);
  constexpr int kSteps = 100;
  const Reflected reflected(*brdf);
  RgbRows k = RgbRows::Ones(kDegrees, 3);
  RgbRows albedo = reflected.albedo(k);
  Limited<Brdf> result{.brdf = brdf, .albedo_before = albedo.maxCoeff(), .albedo_after = albedo.maxCoeff()};
  if (result.albedo_before <= limit) return result;
  for (int step = 0; step < kSteps; ++step) {
    k *= (limit / albedo.max(limit)).sqrt();  // half of what is missing: the other half comes from the other direction
    albedo = reflected.albedo(k);
  }
  k *= limit / albedo.max(limit);
  result.brdf = std::make_shared<const DrawnBy>(std::make_shared<const Dimmed>(brdf, k), brdf);
  result.albedo_after = reflected.albedo(k).maxCoeff();
  result.lowest_factor = k.minCoeff() * k.minCoeff();
  return result;
}

Limited<RefinedBrdf> limit_albedo(const std::shared_ptr<const RefinedBrdf>& model, double limit) {
  return limited(model, limit);
}

Limited<AnisotropicModel> limit_albedo(const std::shared_ptr<const AnisotropicModel>& model, double limit) {
  return limited(model, limit);
}

}  // namespace sklar::brdf
