#pragma once
/// Anisotropic `.bsdf` files of a known reflectance, written as BRDF measurements are.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "brdf/data/bilinear.hpp"
#include "brdf/geometry/frame.hpp"
#include "tests/support/tensor_writer.hpp"

namespace sklar::test {

struct BsdfLayout {
  int folds = 1;         ///< phi_i spans 2 pi / folds from -pi on
  int azimuths = 33;     ///< values of phi_i in the whole turn, both ends included
  int slices = 8;        ///< values of theta_i
  int warp_nodes = 64;   ///< of vndf along theta, of ndf and sigma along both axes
  int value_nodes = 32;  ///< of rgb along both axes
};

/// Fields of a file of `model`, whose warp follows the visible normals of GGX with the given roughnesses.
class AnisotropicBsdf {
 public:
  AnisotropicBsdf(const brdf::Brdf& model, double alpha_x, double alpha_y, const BsdfLayout& layout)
      : model_(model), alpha_x_(alpha_x), alpha_y_(alpha_y), layout_(layout) {
    for (int p = 0; p <= (layout.azimuths - 1) / layout.folds; ++p) {
      phi_i_.push_back(static_cast<float>(-kPi + 2 * kPi * p / (layout.azimuths - 1)));
    }
    for (int t = 0; t < layout.slices; ++t) {
      theta_i_.push_back(static_cast<float>(kPi / 2 * t / (layout.slices - 1)));
    }
    for (int y = 0; y < layout.warp_nodes; ++y) {
      for (int x = 0; x < layout.warp_nodes; ++x) {
        const brdf::Vec3 w = direction(unit(x, layout.warp_nodes), unit(y, layout.warp_nodes));
        ndf_.push_back(static_cast<float>(normals(w)));
        sigma_.push_back(static_cast<float>(visible(w)));
      }
    }
    for (const float phi : phi_i_) {
      for (const float theta : theta_i_) {
        add_slice(brdf::spherical_direction(static_cast<double>(theta), static_cast<double>(phi)));
      }
    }
  }

  [[nodiscard]] std::vector<TensorField> fields() const {
    const auto P = static_cast<std::uint64_t>(phi_i_.size());
    const auto T = static_cast<std::uint64_t>(layout_.slices);
    const auto W = static_cast<std::uint64_t>(layout_.warp_nodes);
    const auto n = static_cast<std::uint64_t>(layout_.value_nodes);
    return {floats("phi_i", {P}, phi_i_),
            floats("theta_i", {T}, theta_i_),
            floats("sigma", {W, W}, sigma_),
            floats("ndf", {W, W}, ndf_),
            floats("vndf", {P, T, W, W}, vndf_),
            floats("rgb", {P, T, 3, n, n}, rgb_),
            {"jacobian", 1, {1}, std::string(1, '\1')}};
  }

 private:
  static constexpr double kPi = std::numbers::pi;

  static double unit(int k, int nodes) { return static_cast<double>(k) / (nodes - 1); }
  static brdf::Vec3 direction(double x, double y) {
    return brdf::spherical_direction(x * x * kPi / 2, 2 * kPi * y - kPi);
  }

  /// D of GGX, and the projected area of its facets that a direction sees.
  [[nodiscard]] double normals(const brdf::Vec3& m) const {
    const double form = std::pow(m.x() / alpha_x_, 2) + std::pow(m.y() / alpha_y_, 2) + m.z() * m.z();
    return 1 / (kPi * alpha_x_ * alpha_y_ * form * form);
  }
  [[nodiscard]] double visible(const brdf::Vec3& w) const {
    return 0.5 * (w.z() + std::sqrt(std::pow(alpha_x_ * w.x(), 2) + std::pow(alpha_y_ * w.y(), 2) + w.z() * w.z()));
  }

  /// The image of vndf for wi, then those of rgb at the points its warp maps to the nodes.
  void add_slice(const brdf::Vec3& wi) {
    const int W = layout_.warp_nodes;
    std::vector<float> density;
    for (int y = 0; y < W; ++y) {
      for (int x = 0; x < W; ++x) {
        const brdf::Vec3 m = direction(unit(x, W), unit(y, W));
        const double sine = std::sin(unit(x, W) * unit(x, W) * kPi / 2);
        density.push_back(static_cast<float>(normals(m) * std::max(wi.dot(m), 0.0) * sine * unit(x, W)));
      }
    }
    vndf_.insert(vndf_.end(), density.begin(), density.end());
    const brdf::BilinearWarp warp(1, W, W, density);
    const brdf::BilinearStack ndf(1, W, W, ndf_);
    const int n = layout_.value_nodes;
    std::vector<std::vector<float>> planes(3);
    for (int node = 0; node < n * n; ++node) {
      const brdf::Vec2 u = sampled(warp, {unit(node % n, n), unit(node / n, n)});
      const brdf::Vec3 half = direction(u.x(), u.y());
      const brdf::Vec3 wo = 2 * wi.dot(half) * half - wi;
      const double scale = wo.z() * 4 * visible(wi) / ndf.at(u, {{0, 0, 0}});
      const brdf::Rgb value = model_.eval(wo, wi.z() > 1e-6 ? wi : brdf::Vec3(wi.x(), wi.y(), 1e-6)) * scale;
      for (std::size_t c = 0; c < 3; ++c) {
        planes[c].push_back(wo.z() > 0 ? static_cast<float>(value[static_cast<int>(c)]) : 0.0F);
      }
    }
    for (const auto& plane : planes) rgb_.insert(rgb_.end(), plane.begin(), plane.end());
  }

  /// The point that the warp takes to s, by bisection: s.y depends on y alone, and s.x grows with x.
  static brdf::Vec2 sampled(const brdf::BilinearWarp& warp, const brdf::Vec2& s) {
    constexpr int kSteps = 40;
    brdf::Vec2 low(0, 0), high(1, 1);
    for (const int axis : {1, 0}) {
      for (int step = 0; step < kSteps; ++step) {
        brdf::Vec2 middle = 0.5 * (low + high);
        const bool below = warp.invert(middle, {{0, 0, 0}})[axis] < s[axis];
        (below ? low : high)[axis] = middle[axis];
      }
      low[axis] = high[axis] = 0.5 * (low[axis] + high[axis]);
    }
    return low;
  }

  const brdf::Brdf& model_;
  double alpha_x_, alpha_y_;
  BsdfLayout layout_;
  std::vector<float> phi_i_, theta_i_, ndf_, sigma_, vndf_, rgb_;
};

}  // namespace sklar::test
