/// Models against numbers that were published of them: tables of other renderers, and values that others fitted to
/// measurements.
///
/// Ward's rolled brass (his table 1) is in analytic_test.cpp, the 28 / (23 pi) of Ashikhmin and Shirley in
/// half_vector_models_test.cpp, the albedo for which Edwards and others build their disk in diffuse_models_test.cpp.
/// No published number is known to us of the Oren-Nayar model in its qualitative form, nor of Neumann's:
/// analytic_models_test.cpp holds them to their equations and to the closed form or the limit of their albedo.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "brdf/analytic/abc.hpp"
#include "brdf/analytic/ashikhmin_premoze_shirley.hpp"
#include "brdf/analytic/ashikhmin_shirley.hpp"
#include "brdf/analytic/blinn_phong.hpp"
#include "brdf/analytic/cook_torrance.hpp"
#include "brdf/analytic/lafortune.hpp"
#include "brdf/analytic/phong.hpp"
#include "brdf/analytic/registry.hpp"
#include "brdf/analytic/ward_lobe.hpp"
#include "tests/support/textbook.hpp"

namespace sklar::brdf {
namespace {

using namespace test;
constexpr double kPi = std::numbers::pi;
constexpr double kDigits = 1e-5;  ///< relative; of numbers computed in single precision

TEST(Lambert, ReflectsAsThePerfectDiffuser) {
  // Nicodemus and others 1977, "Geometrical Considerations and Nomenclature for Reflectance": f_r = 1/pi per steradian.
  const BrdfPtr white = analytic::find("lambert").make({1, 1, 1});
  EXPECT_NEAR(white->eval(degrees(30), degrees(70))[0], 0.3183099, 1e-7);
}

struct GgxAlbedo {
  double cosine, root_alpha, albedo;
};

// Blender 4, intern/cycles/scene/shader.tables, table_ggx_E: directional albedo of GGX with height-correlated masking
// and F = 1 at cos(theta_o) = row / 31, sqrt(alpha) = column / 31; here of rows 1, 5, 15, 31 and columns 15, 23, 31.
constexpr GgxAlbedo kCyclesGgx[] = {
    {1 / 31.0, 15 / 31.0, 0.952526},  {1 / 31.0, 23 / 31.0, 0.931864},  {1 / 31.0, 1, 0.888202},
    {5 / 31.0, 15 / 31.0, 0.861611},  {5 / 31.0, 23 / 31.0, 0.800592},  {5 / 31.0, 1, 0.681600},
    {15 / 31.0, 15 / 31.0, 0.866586}, {15 / 31.0, 23 / 31.0, 0.672945}, {15 / 31.0, 1, 0.457779},
    {1, 15 / 31.0, 0.926694},         {1, 23 / 31.0, 0.638454},         {1, 1, 0.306853},
};
constexpr double kCyclesTolerance = 3e-6;  ///< six digits and the quadrature

TEST(Ggx, HasTheAlbedoOfCyclesTable) {
  for (const GgxAlbedo& expected : kCyclesGgx) {
    const BrdfPtr ggx = analytic::find("ggx").make({1, 1, 1, expected.root_alpha * expected.root_alpha});
    const Vec3 wo = spherical_direction(std::acos(expected.cosine), 0.4);
    EXPECT_NEAR(albedo(*ggx, wo), expected.albedo, kCyclesTolerance) << expected.cosine << " " << expected.root_alpha;
  }
}

TEST(Ggx, LobesOnABaseAddTheAlbedosOfCyclesTable) {
  const GgxAlbedo &rough = kCyclesGgx[8], &smooth = kCyclesGgx[6];
  ASSERT_EQ(rough.cosine, smooth.cosine);
  const Vec3 wo = spherical_direction(std::acos(rough.cosine), 0.4);
  const double alpha = smooth.root_alpha * smooth.root_alpha;
  const BrdfPtr one = analytic::find("ggx_diffuse").make({0.2, 0, 0, 1, 1, 1, alpha});
  const BrdfPtr two = analytic::find("ggx_two_lobes").make({0.2, 0, 0, 1, 1, 1, alpha, 1, 1, 1, 1});
  EXPECT_NEAR(albedo(*one, wo), 0.2 + smooth.albedo, 2 * kCyclesTolerance);
  EXPECT_NEAR(albedo(*two, wo), 0.2 + smooth.albedo + rough.albedo, 3 * kCyclesTolerance);
}

// Mitsuba 3, src/render/tests/test_microfacet.py, from Mitsuba 0.6: D of the normal for alpha_x = 0.1 and alpha_y =
// 0.3, and for alpha = 0.1, of GGX and of Beckmann's distribution alike.
constexpr double kMitsubaAnisotropicPeak = 10.6103287;
constexpr double kMitsubaPeak = 31.8309879;

TEST(Ggx, AnisotropicIsMitsubas) {
  const BrdfPtr ggx = analytic::find("ggx_anisotropic").make({1, 1, 1, 0.1, 0.3});
  EXPECT_NEAR(ggx->eval(Vec3::UnitZ(), Vec3::UnitZ())[0] / (kMitsubaAnisotropicPeak / 4), 1, kDigits);
  // test05_sample_ggx: D cos(theta_h), which is 4 cos(theta_h) times the density of wi where wo is the normal.
  const Vec3 half(0.022205815, 0.11538482, 0.99307263);
  const double density = 4 * half.z() * ggx->pdf(Vec3::UnitZ(), 2 * half.z() * half - Vec3::UnitZ());
  EXPECT_NEAR(density / 7.5235577, 1, kDigits);
  // test03_smith_g1_ggx: G1 at 60 degrees along y, and at 88.2 degrees for azimuths of 2 pi n / 19.
  const auto masking = [&](double theta, double phi) {
    const Vec3 wo = spherical_direction(theta, phi);
    return 4 * wo.z() * ggx->pdf(wo, Vec3(-wo.x(), -wo.y(), wo.z())) / kMitsubaAnisotropicPeak;
  };
  EXPECT_NEAR(masking(kPi / 3, kPi / 2) / 0.94031686, 1, kDigits);
  EXPECT_NEAR(masking(0.49 * kPi, 0) / 0.46130955, 1, kDigits);
  EXPECT_NEAR(masking(0.49 * kPi, 2 * kPi * 2 / 19) / 0.26822716, 1, kDigits);
  EXPECT_NEAR(masking(0.49 * kPi, 2 * kPi * 5 / 19) / 0.18922243, 1, kDigits);
}

TEST(CookTorrance, FacetsAreMitsubas) {
  // test02_eval_pdf_beckmann: D at 0, at 0.1 and at pi n / 19. For wi = wo = h nothing is masked: f_r = F D / (4
  // cos^2).
  const CookTorranceLobe lobe(Rgb::Ones(), 0.1);
  for (const auto& [theta, expected] :
       {std::pair(0.0, kMitsubaPeak), {0.1, 11.86709118}, {kPi / 19, 2.07673073}, {2 * kPi / 19, 3.02855828e-4}}) {
    const Vec3 half = spherical_direction(theta, 0.3);
    EXPECT_NEAR(4 * half.z() * half.z() * lobe.eval(half, half)[0] / expected, 1, kDigits) << theta;
  }
}

TEST(MicrofacetGenerator, MasksGgxNormalsAsMitsuba) {
  // test03_smith_g1_ggx: G1 for alpha = 0.1 at pi (1/3 + n / 114). In the mirror direction f_r = D G1^2 / (4 cos^2).
  constexpr double kAlpha = 0.1, kTable = 2e-3;  // kTable: of the tabulated normals
  std::vector<double> theta, normals;
  for (int n = 0; n <= 512; ++n) {
    theta.push_back(kPi / 2 * std::pow(n / 512.0, 3));
    normals.push_back(std::pow(1 - (1 - kAlpha * kAlpha) * std::pow(std::cos(theta.back()), 2), -2));
  }
  const AshikhminPremozeShirleyLobe lobe(Rgb::Ones(), std::make_shared<const TabulatedDensity>(theta, normals));
  for (const auto& [n, expected] : {std::pair(0, 0.99261039), {10, 0.96378750}, {15, 0.85189372}, {17, 0.65144652}}) {
    const Vec3 wo = spherical_direction(kPi / 3 + kPi / 6 * n / 19, 0.3);
    const double value = lobe.eval(wo, {-wo.x(), -wo.y(), wo.z()})[0];
    EXPECT_NEAR(std::sqrt(4 * wo.z() * wo.z() * value / kMitsubaPeak) / expected, 1, kTable) << n;
  }
}

/// A model with the values of a published fit, as far as the red channel goes: a diffuse base, and a lobe as the
/// authors scale it.
struct Fit {
  const char* name;
  double diffuse, scale;
  BrdfPtr lobe;

  /// Share of light from everywhere that is reflected, to 1e-3 of it, from draws.
  [[nodiscard]] double mean_albedo() const {
    constexpr int kDraws = 40000;
    Rng rng(seed_of_this_test());
    double sum = 0;
    for (int n = 0; n < kDraws; ++n) {
      const Vec3 wo = spherical_direction(std::acos(std::sqrt((n + 0.5) / kDraws)), 0);
      const double first = uniform(rng);
      sum += lobe->sample(wo, {first, uniform(rng)}).weight[0];
    }
    return diffuse + scale * sum / kDraws;
  }

  /// The lobe for wi = wo = n.
  [[nodiscard]] double peak() const { return scale * lobe->eval(Vec3::UnitZ(), Vec3::UnitZ())[0]; }
};

template <typename Lobe, typename... Values>
Fit fit(const char* name, double diffuse, double scale, const Values&... values) {
  return {name, diffuse, scale, std::make_shared<const Lobe>(values...)};
}

Rgb grey(double value) {
  return Rgb::Constant(value);
}

/// Each within `tolerance`, relative, of the mean of all.
void expect_alike(const std::vector<Fit>& fits, double tolerance) {
  std::vector<double> found;
  double mean = 0;
  for (const Fit& one : fits) {
    found.push_back(one.mean_albedo());
    mean += found.back() / static_cast<double>(fits.size());
  }
  for (std::size_t n = 0; n < fits.size(); ++n) EXPECT_NEAR(found[n] / mean, 1, tolerance) << fits[n].name;
}

// Ngan, Durand and Matusik 2005, "Experimental Analysis of BRDF Models": their fits of materials of MERL, as collected
// in the files fits/ngan_*.fit of BBM (github.com/bsdfbenchmark/bbm). Fits of one measurement by different models
// reflect the same share of the light, if each is read with the factor that it was made with: ours, but Blinn-Phong
// with (n + 2) / (2 pi), whose albedo at normal incidence is 4 n / (n + 4). Of a paint that all of them fit well.
TEST(PublishedFits, OfSilverPaintReflectAlike) {
  expect_alike({fit<WardLobe>("Ward", 0.049, 0.269, grey(1), 0.185, 0.185, WardNormalisation::ward),
                fit<WardLobe>("Ward-Duer", 0.0703, 0.159, grey(1), 0.208, 0.208, WardNormalisation::duer),
                fit<BlinnPhongLobe>("Blinn-Phong", 0.0695, 0.0742 * 4 * 75 / 79, grey(1), 75.0),
                fit<LafortuneLobe>("Lafortune", 0.0552, 0.434, grey(1), Vec3(-1, -1, 0.559 / 0.587), 21.4),
                fit<CookTorranceLobe>("Cook-Torrance", 0.0652, 0.238, grey(0.661), 0.195),
                fit<AshikhminShirley>("Ashikhmin-Shirley", 0.0547, 0.197, grey(0), grey(0.999), 40.5, 40.5)},
               0.015);
}

// Lafortune's fit is the Phong lobe here. What the others have at their peak is their factor alone, and all three grow
// with the angle as 1 / cos^2.
TEST(PublishedFits, OfBrassReflectAlike) {
  const Fit duer = fit<WardLobe>("Ward-Duer", 0.0486, 0.0715, grey(1), 0.00659, 0.00659, WardNormalisation::duer);
  const Fit facets = fit<CookTorranceLobe>("Cook-Torrance", 0.0475, 0.124, grey(0.596), 0.00668);
  const Fit shirley =
      fit<AshikhminShirley>("Ashikhmin-Shirley", 0.0486, 0.0717, grey(0), grey(0.999), 45800.0, 45800.0);
  const Fit phong = fit<PhongLobe>("Phong", 0.0387, 0.118, grey(1), 10700.0);
  expect_alike({duer, facets, shirley, phong}, 0.02);
  EXPECT_NEAR(facets.peak() / duer.peak(), 1, 0.01);
  EXPECT_NEAR(shirley.peak() / duer.peak(), 1, 0.01);
}

// Low, Kronander, Ynnerman and Unger 2012, the fits of MERL's materials by their error E2 with the smooth-surface model
// and with Cook-Torrance, whose factor is 4 times ours, as in the files fits/low_*_E2.fit of BBM.
TEST(PublishedFits, OfMetallicPaintsByAbcReflectAsByCookTorrance) {
  const auto f0 = [](double eta) { return grey(std::pow((eta - 1) / (eta + 1), 2)); };
  const std::pair<Fit, Fit> fits[] = {
      {fit<AbcLobe>("silver-metallic-paint", 0.0099, 1, grey(5.29566), 7.575785, 2.239364, 2.25156),
       fit<CookTorranceLobe>("", 0.0564, 4 * 0.07115, f0(9.09077), 0.193783)},
      {fit<AbcLobe>("blue-metallic-paint", 0.0016, 1, grey(1.38238), 9.706637, 1.650875, 2.02967),
       fit<CookTorranceLobe>("", 0.0162, 4 * 0.01764, f0(8.89802), 0.210792)},
      {fit<AbcLobe>("gold-metallic-paint", 0.0094, 1, grey(5.34906), 9.81648, 1.545613, 1.91911),
       fit<CookTorranceLobe>("", 0.0675, 4 * 0.06133, f0(9.13257), 0.218404)}};
  for (const auto& [abc, facets] : fits) EXPECT_NEAR(abc.mean_albedo() / facets.mean_albedo(), 1, 0.015) << abc.name;
}

}  // namespace
}  // namespace sklar::brdf
