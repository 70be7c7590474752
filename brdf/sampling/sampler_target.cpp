#include "brdf/sampling/sampler_target.hpp"

#include <numbers>

#include "brdf/luminance.hpp"

namespace sklar::brdf {
namespace {

constexpr int kCoarse = 48;
constexpr int kFine = 48;
constexpr double kDecades = 7;
constexpr double kFollowing = 0.5;  // share of the fine points that go where the light is

/// Nodes of an integral over theta_h / horizon in [0,1].
struct Rule {
  std::vector<double> node, weight;
};

/// Edges 0, 10^-7, .., 1.
double coarse_edge(int i) {
  return i == 0 ? 0 : std::pow(10, kDecades * (static_cast<double>(i) / kCoarse - 1));
}

Rule coarse_rule() {
  Rule rule;
  for (int i = 0; i < kCoarse; ++i) {
    rule.node.push_back((coarse_edge(i) + coarse_edge(i + 1)) / 2);
    rule.weight.push_back(coarse_edge(i + 1) - coarse_edge(i));
  }
  return rule;
}

/// Equal shares of a mixture of the light in the coarse intervals and of cbrt(theta_h), each with its middle; the first
/// share is `first` of the others, so that different azimuths have different nodes.
Rule fine_rule(const double* light, double first) {
  double total = 0;
  for (int i = 0; i < kCoarse; ++i) total += light[i];
  const double following = total > 0 ? kFollowing : 0;
  std::vector<double> level = {0};
  for (int i = 0; i < kCoarse; ++i) {
    const double spread = std::cbrt(coarse_edge(i + 1)) - std::cbrt(coarse_edge(i));
    level.push_back(level.back() + (1 - following) * spread + (total > 0 ? following * light[i] / total : 0));
  }
  Rule rule;
  int i = 0;
  double from = 0;
  for (int j = 0; j <= kFine; ++j) {
    const double wanted = level.back() * (j == kFine ? 1.0 : (j + first) / kFine);
    while (i + 1 < kCoarse && level[static_cast<std::size_t>(i) + 1] < wanted) ++i;
    const double below = level[static_cast<std::size_t>(i)], above = level[static_cast<std::size_t>(i) + 1];
    const double inside = (wanted - below) / (above - below);
    const double to = j == kFine ? 1 : coarse_edge(i) + (coarse_edge(i + 1) - coarse_edge(i)) * inside;
    rule.node.push_back((from + to) / 2);
    rule.weight.push_back(to - from);
    from = to;
  }
  return rule;
}

/// Points of one theta_o, evaluated together.
class Lines {
 public:
  Lines(double cosine, int azimuths, int turns)
      : wo_(std::sqrt(1 - cosine * cosine), 0, cosine), azimuths_(azimuths), turns_(turns) {}

  /// Adds the points of a rule at one azimuth.
  void add(int azimuth, const Rule& rule) {
    const double phi = std::numbers::pi * (azimuth + 0.5) / azimuths_, dphi = std::numbers::pi / azimuths_;
    const Vec2 direction(std::cos(phi), std::sin(phi));
    // Where wi meets the horizon: |z - tan(theta_o)| = 1 / cos(theta_o) for z = tan(theta_h) exp(i phi).
    const double b = wo_.x() * direction.x(), r = std::sqrt(wo_.z() * wo_.z() + b * b);
    const double most = std::atan(b < 0 ? wo_.z() / (r - b) : (r + b) / wo_.z());
    for (std::size_t j = 0; j < rule.node.size(); ++j) {
      const double theta_h = most * rule.node[j];
      const Vec3 half(std::sin(theta_h) * direction.x(), std::sin(theta_h) * direction.y(), std::cos(theta_h));
      const double cos_d = wo_.dot(half);
      const Vec3 wi = 2 * cos_d * half - wo_;
      wi_.push_back({wi.x(), wi.y(), std::max(wi.z(), 1e-12)});
      measure_.push_back(2 * dphi * 4 * cos_d * std::sin(theta_h) * most * rule.weight[j]);
    }
  }

  /// The light of each point, times its measure.
  [[nodiscard]] std::vector<double> light(const Brdf& brdf) const {
    const auto count = static_cast<Eigen::Index>(wi_.size());
    std::vector<double> sums(wi_.size());
    for (int turn = 0; turn < 2 * turns_; ++turn) {
      const int step = turn / 2;
      const double phi = 2 * std::numbers::pi * step / turns_, c = std::cos(phi), s = std::sin(phi);
      const double side = turn % 2 == 0 ? 1 : -1;
      Directions wo(count, 3), wi(count, 3);
      for (Eigen::Index i = 0; i < count; ++i) {
        const Vec3& w = wi_[static_cast<std::size_t>(i)];
        wo.row(i) << c * wo_.x(), s * wo_.x(), wo_.z();
        wi.row(i) << c * w.x() - s * side * w.y(), s * w.x() + c * side * w.y(), w.z();
      }
      const RgbRows f = brdf.eval(wo, wi);
      for (Eigen::Index i = 0; i < count; ++i) {
        const auto n = static_cast<std::size_t>(i);
        const double value = luminance(f.row(i).transpose());
        if (std::isfinite(value) && value > 0) sums[n] += value * wi_[n].z() * measure_[n] / (2 * turns_);
      }
    }
    return sums;
  }

  [[nodiscard]] std::vector<TargetPoint> points(const Brdf& brdf) const {
    const std::vector<double> mass = light(brdf);
    double total = 0;
    for (const double m : mass) total += m;
    std::vector<TargetPoint> result;
    const Outgoing given(wo_);
    for (std::size_t i = 0; i < mass.size(); ++i) {
      result.push_back({WiCoordinates(given, wo_, wi_[i]), measure_[i], total > 0 ? mass[i] / total : 0});
    }
    return result;
  }

 private:
  Vec3 wo_;
  int azimuths_, turns_;
  std::vector<Vec3> wi_{};
  std::vector<double> measure_{};
};

}  // namespace

std::vector<TargetPoint> sampler_target(const Brdf& brdf, double cosine, int azimuths, int turns) {
  Lines coarse(cosine, azimuths, turns), fine(cosine, azimuths, turns);
  const Rule rule = coarse_rule();
  for (int k = 0; k < azimuths; ++k) coarse.add(k, rule);
  const std::vector<double> light = coarse.light(brdf);
  for (int k = 0; k < azimuths; ++k) {
    const double golden = (k + 0.5) * (std::numbers::phi - 1);
    fine.add(k, fine_rule(&light[static_cast<std::size_t>(k * kCoarse)], golden - std::floor(golden)));
  }
  return fine.points(brdf);
}

}  // namespace sklar::brdf
