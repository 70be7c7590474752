#include "brdf/study/furnace.hpp"

#include <tbb/parallel_for.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "brdf/geometry/frame.hpp"
#include "copula/error.hpp"
#include "copula/random.hpp"

namespace sklar::brdf {

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
    const Vec3 wo = spherical_direction(theta_o(row), 0);
    Rgb mean = Rgb::Zero(), squares = Rgb::Zero();  // Welford 1962
    for (Eigen::Index n = 1; n <= draws; ++n) {
      const double first = uniform(rng);
      const Rgb weight = brdf.sample(wo, {first, uniform(rng)}).weight;
      const Rgb step = weight - mean;
      mean += step / static_cast<double>(n);
      squares += step * (weight - mean);
    }
    const auto count = static_cast<double>(draws);
    curve.albedo.row(row) = mean.transpose();
    curve.sigma.row(row) = (squares / (count * (count - 1))).sqrt().transpose();
  });
  return curve;
}

}  // namespace sklar::brdf
