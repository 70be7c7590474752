#include "brdf/study/furnace.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "brdf/geometry/frame.hpp"
#include "copula/error.hpp"
#include "copula/random.hpp"

namespace sklar::brdf {
namespace {

/// Welford 1962.
struct RunningMean {
  Rgb mean = Rgb::Zero(), squares = Rgb::Zero();  ///< squares of the distances from the mean, summed
  double count = 0;

  void add(const Rgb& value) {
    const Rgb step = value - mean;
    mean += step / ++count;
    squares += step * (value - mean);
  }
};

RunningMean mean_weight(const Brdf& brdf, const Vec3& wo, Eigen::Index draws, Rng& rng) {
  constexpr Eigen::Index kAtOnce = 1024;
  RunningMean mean;
  for (Eigen::Index done = 0; done < draws; done += kAtOnce) {
    const Eigen::Index count = std::min(kAtOnce, draws - done);
    Eigen::ArrayX2d uniforms(count, 2);
    for (Eigen::Index n = 0; n < count; ++n) {
      uniforms(n, 0) = uniform(rng);
      uniforms(n, 1) = uniform(rng);
    }
    const Samples samples = brdf.sample(wo.transpose().array().replicate(count, 1), uniforms);
    for (Eigen::Index n = 0; n < count; ++n) mean.add(samples.weight.row(n).transpose());
  }
  return mean;
}

}  // namespace

FurnaceCurve furnace_albedo(const Brdf& brdf, const Eigen::ArrayXd& theta_o, Eigen::Index draws, std::uint64_t seed) {
  if (draws < 2) {
    throw std::invalid_argument("furnace_albedo: draws must be at least 2, got " + std::to_string(draws));
  }
  for (const double theta : theta_o) {
    if (!(theta >= 0 && theta < std::numbers::pi / 2)) {
      throw std::domain_error("furnace_albedo: theta_o must be in [0, pi/2), got " + to_text(theta));
    }
  }
  FurnaceCurve curve{RgbRows(theta_o.size(), 3), RgbRows(theta_o.size(), 3)};
  tbb::parallel_for(Eigen::Index{0}, theta_o.size(), [&](Eigen::Index row) {
    Rng rng(seed + static_cast<std::uint64_t>(row));
    const RunningMean mean = mean_weight(brdf, spherical_direction(theta_o(row), 0), draws, rng);
    const auto count = static_cast<double>(draws);
    curve.albedo.row(row) = mean.mean.transpose();
    curve.sigma.row(row) = (mean.squares / (count * (count - 1))).sqrt().transpose();
  });
  return curve;
}

}  // namespace sklar::brdf
