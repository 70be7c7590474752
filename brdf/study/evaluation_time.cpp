#include "brdf/study/evaluation_time.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "copula/random.hpp"
#include "copula/study/timing.hpp"

namespace sklar::brdf {
namespace {

Directions uniform_hemisphere(Rng& rng, Eigen::Index count) {
  Directions w(count, 3);
  for (Eigen::Index row = 0; row < count; ++row) {
    const double z = uniform(rng), phi = 2 * std::numbers::pi * uniform(rng), radius = std::sqrt(1 - z * z);
    w.row(row) << radius * std::cos(phi), radius * std::sin(phi), z;
  }
  return w;
}

constexpr Eigen::Index kBatch = 4096;

struct DirectionPairs {
  DirectionPairs() : DirectionPairs(Rng(1)) {}
  explicit DirectionPairs(Rng rng) : wo(uniform_hemisphere(rng, kBatch)), wi(uniform_hemisphere(rng, kBatch)) {}

  Directions wo, wi;
};

/// @param batch gives a sum of its values, NaN where it failed.
template <class Batch>
double ns_of_one(const Batch& batch) {
  double sum = 0;
  const double seconds = seconds_per_call([&] { sum = batch(); });
  return std::isnan(sum) ? std::numeric_limits<double>::quiet_NaN() : seconds / kBatch * 1e9;
}

}  // namespace

double evaluation_ns(const Brdf& brdf) {
  const DirectionPairs pairs;
  return ns_of_one([&] { return brdf.eval(pairs.wo, pairs.wi).sum(); });
}

double single_evaluation_ns(const Brdf& brdf) {
  const DirectionPairs pairs;
  return ns_of_one([&] {
    Rgb sum = Rgb::Zero();
    for (Eigen::Index i = 0; i < pairs.wo.rows(); ++i) {
      sum += brdf.eval(Vec3(pairs.wo.row(i).matrix()), Vec3(pairs.wi.row(i).matrix()));
    }
    return sum.sum();
  });
}

}  // namespace sklar::brdf
