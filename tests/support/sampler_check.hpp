#pragma once
/// What every sampler of a Brdf must do, for one wo: draws follow pdf, pdf integrates to at most 1, the weight is
/// f cos / pdf, and albedo from importance samples agrees with albedo from uniform ones.

#include <array>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "brdf/brdf.hpp"
#include "brdf/geometry/frame.hpp"
#include "copula/random.hpp"
#include "tests/support/chi_square.hpp"

namespace sklar::test {

/// Integral over a rectangle: 4 x 4 Gauss-Legendre nodes, quartered until both levels agree to `tolerance`.
inline double integrate(const std::function<double(double, double)>& f, double x0, double x1, double y0, double y1,
                        double tolerance, int depth = 12) {
  constexpr std::array<double, 4> kNode = {-0.8611363115940526, -0.3399810435848563, 0.3399810435848563,
                                           0.8611363115940526};
  constexpr std::array<double, 4> kWeight = {0.3478548451374538, 0.6521451548625461, 0.6521451548625461,
                                             0.3478548451374538};
  const auto gauss = [&](double xa, double xb, double ya, double yb) {
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) {
        sum +=
            kWeight[i] * kWeight[j] * f(0.5 * (xa + xb + (xb - xa) * kNode[i]), 0.5 * (ya + yb + (yb - ya) * kNode[j]));
      }
    }
    return 0.25 * sum * (xb - xa) * (yb - ya);
  };
  const double x = 0.5 * (x0 + x1);
  const double y = 0.5 * (y0 + y1);
  const double fine = gauss(x0, x, y0, y) + gauss(x, x1, y0, y) + gauss(x0, x, y, y1) + gauss(x, x1, y, y1);
  if (depth == 0 || std::abs(fine - gauss(x0, x1, y0, y1)) <= tolerance) return fine;
  return integrate(f, x0, x, y0, y, tolerance / 4, depth - 1) + integrate(f, x, x1, y0, y, tolerance / 4, depth - 1) +
         integrate(f, x0, x, y, y1, tolerance / 4, depth - 1) + integrate(f, x, x1, y, y1, tolerance / 4, depth - 1);
}

/// A million, or ten times $SKLAR_DRAWS.
inline int sampler_draws() {
  const char* given = std::getenv("SKLAR_DRAWS");
  return given == nullptr ? 1000000 : 10 * std::atoi(given);
}

struct SamplerCheck {
  int draws = sampler_draws();
  int theta_cells = 32;
  int phi_cells = 64;
  int tests = 1;                  ///< how many calls share the level of significance
  double mass_tolerance = 1e-9;   ///< of the integral of pdf over a cell
  double missing_tolerance = -1;  ///< >= 0: pdf must integrate to 1 within this
};

/// Equal cells of the hemisphere in theta and phi, and one more for all below the horizon.
class SamplerCells {
 public:
  explicit SamplerCells(const SamplerCheck& options)
      : rows_(options.theta_cells),
        columns_(options.phi_cells),
        theta_step_(kPi / 2 / rows_),
        phi_step_(2 * kPi / columns_),
        tolerance_(options.mass_tolerance) {}

  [[nodiscard]] std::size_t count() const { return static_cast<std::size_t>(rows_ * columns_) + 1; }

  [[nodiscard]] std::size_t index(const brdf::Vec3& wi) const {
    if (!(wi.z() > 0)) return count() - 1;
    const int row = std::min(static_cast<int>(brdf::polar_angle(wi) / theta_step_), rows_ - 1);
    const int column = std::min(static_cast<int>((std::atan2(wi.y(), wi.x()) + kPi) / phi_step_), columns_ - 1);
    return static_cast<std::size_t>(row * columns_ + column);
  }

  /// The integral of pdf over each cell; the last one is what is missing to 1.
  [[nodiscard]] std::vector<double> masses(const brdf::Brdf& model, const brdf::Vec3& wo) const {
    const auto density = [&](double theta, double phi) {
      return model.pdf(wo, brdf::spherical_direction(theta, phi)) * std::sin(theta);
    };
    std::vector<double> result;
    double rest = 1;
    for (int cell = 0; cell < rows_ * columns_; ++cell) {
      const int row = cell / columns_;
      const int column = cell % columns_;
      const double theta = theta_step_ * row;
      const double phi = phi_step_ * column - kPi;
      result.push_back(integrate(density, theta, theta + theta_step_, phi, phi + phi_step_, tolerance_));
      rest -= result.back();
    }
    result.push_back(rest);
    return result;
  }

 private:
  static constexpr double kPi = std::numbers::pi;
  int rows_, columns_;
  double theta_step_, phi_step_, tolerance_;
};

/// Mean of RGB values and the variance of that mean.
class RgbMean {
 public:
  void add(const brdf::Rgb& value) {
    sum_ += value;
    square_ += value.square();
    ++count_;
  }

  [[nodiscard]] brdf::Rgb mean() const { return sum_ / count_; }
  [[nodiscard]] brdf::Rgb variance() const { return (square_ / count_ - mean().square()).max(0.0) / count_; }

 private:
  brdf::Rgb sum_ = brdf::Rgb::Zero();
  brdf::Rgb square_ = brdf::Rgb::Zero();
  double count_ = 0;
};

/// A direction uniform over the hemisphere, density 1 / (2 pi).
inline brdf::Vec3 uniform_hemisphere(Rng& rng) {
  const double z = uniform(rng);
  const double phi = 2 * std::numbers::pi * uniform(rng);
  const double radius = std::sqrt(1 - z * z);
  return {radius * std::cos(phi), radius * std::sin(phi), z};
}

/// wo at which samplers are tested, from the normal to grazing.
inline const std::vector<brdf::Vec3>& sampled_directions() {
  static const std::vector<brdf::Vec3> kList = [] {
    constexpr double kDegree = std::numbers::pi / 180;
    std::vector<brdf::Vec3> result;
    for (const auto& [theta, phi] : {std::pair(0.0, 0.0),
                                     {3.0, 200.0},
                                     {20.0, 0.0},
                                     {45.0, 100.0},
                                     {62.0, 30.0},
                                     {75.0, 300.0},
                                     {85.0, 170.0},
                                     {89.0, 45.0}}) {
      result.push_back(brdf::spherical_direction(theta * kDegree, phi * kDegree));
    }
    return result;
  }();
  return kList;
}

/// weight * pdf == f cos; nothing above the horizon has density 0, nothing below has weight.
inline void expect_consistent(const brdf::Brdf& model, const brdf::Vec3& wo, const brdf::Sample& draw) {
  if (!(draw.wi.z() > 0)) {
    ASSERT_TRUE((draw.weight == 0).all());
    return;
  }
  ASSERT_GT(draw.pdf, 0) << "a draw where the density is 0";
  ASSERT_EQ(draw.pdf, model.pdf(wo, draw.wi));
  const brdf::Rgb value = model.eval(wo, draw.wi) * draw.wi.z();
  ASSERT_TRUE(((draw.weight * draw.pdf - value).abs() <= 1e-14 * value.abs()).all());
}

/// @return the integral of pdf over the hemisphere; the rest is the share of draws below the horizon.
inline double check_sampler(const brdf::Brdf& model, const brdf::Vec3& wo, std::uint64_t seed,
                            const SamplerCheck& options = {}) {
  const std::string what = "theta_o = " + std::to_string(brdf::polar_angle(wo) * 180 / std::numbers::pi) + " degrees";
  SCOPED_TRACE(what);
  const SamplerCells cells(options);
  std::vector<double> expected = cells.masses(model, wo);
  const double total = 1 - expected.back();
  EXPECT_LE(total, 1 + std::max(1e-6, options.mass_tolerance * options.theta_cells * options.phi_cells));
  if (options.missing_tolerance >= 0) {
    EXPECT_NEAR(total, 1, options.missing_tolerance);
  }
  expected.back() = std::max(expected.back(), 0.0);
  for (double& mass : expected) mass *= options.draws;

  Rng rng(seed);
  std::vector<double> observed(cells.count());
  RgbMean by_pdf, by_uniform, uniform_square;
  for (int n = 0; n < options.draws && !testing::Test::HasFatalFailure(); ++n) {
    const double first = uniform(rng);
    const brdf::Sample draw = model.sample(wo, {first, uniform(rng)});
    expect_consistent(model, wo, draw);
    ++observed[cells.index(draw.wi)];
    by_pdf.add(draw.weight);
    uniform_square.add(draw.weight.square() * draw.pdf);
    const brdf::Vec3 wi = uniform_hemisphere(rng);
    by_uniform.add(model.eval(wo, wi) * (2 * std::numbers::pi * wi.z()));
  }
  expect_chi_square(observed, expected, options.tests, what);
  // The variance of uniform draws by the draws that follow the light: of a narrow lobe uniform ones hardly tell it.
  const brdf::Rgb of_uniform =
      (2 * std::numbers::pi * uniform_square.mean() - by_pdf.mean().square()).max(0.0) / options.draws;
  const brdf::Rgb error = (by_pdf.variance() + of_uniform).sqrt();
  EXPECT_TRUE(((by_pdf.mean() - by_uniform.mean()).abs() <= 4 * error + 1e-12).all())
      << "albedo " << by_pdf.mean().transpose() << " by pdf, " << by_uniform.mean().transpose() << " by uniform draws";
  return total;
}

}  // namespace sklar::test
