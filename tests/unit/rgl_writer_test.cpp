#include "brdf/data/rgl_writer.hpp"

#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "brdf/analytic/ggx.hpp"
#include "brdf/analytic/synthetic.hpp"
#include "brdf/data/bilinear.hpp"
#include "brdf/data/colour.hpp"
#include "brdf/data/material.hpp"
#include "brdf/data/rgl.hpp"
#include "brdf/data/tensor_file.hpp"
#include "brdf/geometry/frame.hpp"
#include "brdf/model/refined_fit.hpp"
#include "brdf/study/metrics.hpp"
#include "copula/error.hpp"
#include "copula/file.hpp"
#include "copula/random.hpp"
#include "tests/support/function_brdf.hpp"
#include "tests/support/message.hpp"
#include "tests/support/rgl_reader.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sklar::brdf {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180;
constexpr double kFloat = 1e-5;  // relative, of values in single precision behind a warp in single precision

constexpr RglLayout kSmall{.azimuths = 9, .slices = 6, .warp_rows = 16, .warp_columns = 32, .nodes = 12};

test::Direction direction(const Vec3& w) {
  return {w.x(), w.y(), w.z()};
}

/// What a renderer makes of one known direction: sums over a grid of the other one's hemisphere.
struct ReadBack {
  double difference = 0;  ///< integral of |f - g| cos, channels summed
  double reflected = 0;   ///< and of g cos
  double pdf = 0;         ///< integral

  ReadBack(const test::RglFile& file, const Brdf& model, const Vec3& known) {
    constexpr int kCosines = 100, kAzimuths = 160;
    const test::RglSlice slice(file, direction(known));
    const double solid_angle = 2 * kPi / (kCosines * kAzimuths);
    for (int i = 0; i < kCosines; ++i) {
      for (int j = 0; j < kAzimuths; ++j) {
        const double cosine = (i + 0.5) / kCosines;
        const Vec3 other = spherical_direction(std::acos(cosine), (j + 0.5) / kAzimuths * 2 * kPi);
        const std::vector<double> found = slice.f_cos(direction(other));
        const Rgb expected = model.eval(known, other) * cosine;
        difference += (Rgb(found[0], found[1], found[2]) - expected).abs().sum() * solid_angle;
        reflected += expected.sum() * solid_angle;
        pdf += slice.pdf(direction(other)) * solid_angle;
      }
    }
  }
};

class RglWriter : public test::TemporaryFolder {
 protected:
  [[nodiscard]] std::filesystem::path path() const { return folder_ / "x.bsdf"; }

  /// Between nodes of theta_i as well as near them. @return the relative L1 error of f cos over all directions.
  double error(const Brdf& model, const std::vector<double>& azimuths, double least_mass = 0.995) const {
    constexpr double kMostMass = 1.002;
    const test::RglFile file(path());
    double difference = 0, reflected = 0;
    for (const double theta : {0.0, 3.0, 20.0, 37.0, 45.0, 57.0, 69.0, 75.0, 80.0}) {
      for (const double phi : azimuths) {
        const ReadBack read(file, model, spherical_direction(theta * kDegree, phi));
        EXPECT_GT(read.pdf, least_mass) << theta << " " << phi;
        EXPECT_LT(read.pdf, kMostMass) << theta << " " << phi;
        difference += read.difference;
        reflected += read.reflected;
      }
    }
    return difference / reflected;
  }
};

const Ggx kGloss({0.9, 0.6, 0.3}, 0.2);
const test::FunctionBrdf kConstant([](const Vec3&, const Vec3&) -> Rgb { return Rgb(0.5, 0.3, 0.1) / kPi; });
const test::FunctionBrdf kCoated([](const Vec3& wo, const Vec3& wi) -> Rgb {
  return 0.2 / kPi + 0.6 * kGloss.eval(wo, wi);
});

TEST_F(RglWriter, ARendererReadsTheReflectance) {
  constexpr double kConstantError = 0.006, kCoatedError = 0.006;
  write_rgl(path(), kConstant);
  EXPECT_LT(error(kConstant, {0.3}), kConstantError);
  write_rgl(path(), kCoated);
  EXPECT_LT(error(kCoated, {-1.0}), kCoatedError);
}

TEST_F(RglWriter, AnAnisotropicFileCoversTheTurn) {
  constexpr double kError = 0.015;      // seen: 0.0087
  constexpr double kLeastMass = 0.985;  // seen: 0.9916, between two azimuths at 80 degrees
  const Ggx brushed({0.9, 0.6, 0.3}, 0.2, 0.4);
  const test::FunctionBrdf model(
      [&](const Vec3& wo, const Vec3& wi) -> Rgb { return 0.1 / kPi + brushed.eval(wo, wi); }, {.isotropic = false});
  write_rgl(path(), model);
  EXPECT_LT(error(model, {-2.0, 0.4, 3.1}, kLeastMass), kError);
  const RglMaterial read(path());
  EXPECT_FALSE(read.isotropic());
  EXPECT_EQ(read.folds(), 1);
}

TEST_F(RglWriter, AFittedModelLooksTheSame) {
  constexpr double kLeastPsnr = 45;  // dB
  std::vector<MeasuredTable> tables = {builtin_material()};
  if (const char* data = std::getenv("SKLAR_TEST_DATA")) {
    const auto folder = std::filesystem::path(data) / "materials" / "rgl";
    tables.push_back(load_material(folder / "aurora_white_rgb.bsdf"));
  }
  for (const MeasuredTable& table : tables) {
    const RefinedFit fit = fit_refined(table, {.evaluations = 30});
    write_rgl(path(), *fit.brdf);
    const CellValues model = predict(*fit.brdf, table), read = predict(*read_material_brdf(path()), table);
    const std::array<const CellValues*, 2> both = {&model, &read};
    const std::vector<SpherePixels> pixels = sphere_pixels(both);
    EXPECT_GT(sphere_psnr_linear_db(pixels[0], pixels[1]).mean(), kLeastPsnr) << table.name;
  }
}

TEST_F(RglWriter, BothReadersAgree) {
  const Ggx brushed({0.9, 0.6, 0.3}, 0.2, 0.4);
  for (const Brdf* model : {static_cast<const Brdf*>(&kCoated), static_cast<const Brdf*>(&brushed)}) {
    write_rgl(path(), *model, {.layout = kSmall});
    const RglMaterial material(path());
    const test::RglFile file(path());
    Rng rng(3);
    for (int n = 0; n < 300; ++n) {
      const Vec3 wi = spherical_direction(1.5 * uniform(rng), 2 * kPi * uniform(rng));
      const Vec3 wo = spherical_direction(1.5 * uniform(rng), 2 * kPi * uniform(rng));
      const Rgb expected = material.f_cos(wo, wi);
      const std::vector<double> found = test::RglSlice(file, direction(wi)).f_cos(direction(wo));
      for (int c = 0; c < 3; ++c) {
        ASSERT_NEAR(found[static_cast<std::size_t>(c)], expected[c], kFloat * (1 + expected[c])) << n;
      }
    }
  }
}

TEST_F(RglWriter, SpectraHaveTheColoursOfTheRgbForm) {
  write_rgl(folder_ / "rgb.bsdf", kCoated, {.layout = kSmall});
  write_rgl(folder_ / "spectra.bsdf", kCoated, {.form = RglForm::spectra, .layout = kSmall});
  const test::RglFile spectra(folder_ / "spectra.bsdf");
  EXPECT_TRUE(spectra.spectral());
  EXPECT_EQ(spectra.field("wavelengths").at(0), 360.0F);
  EXPECT_EQ(spectra.field("wavelengths").at(spectra.channels() - 1), 840.0F);
  const RglMaterial first(folder_ / "rgb.bsdf"), second(folder_ / "spectra.bsdf");
  Rng rng(4);
  for (int n = 0; n < 300; ++n) {
    const Vec3 wi = spherical_direction(1.5 * uniform(rng), 2 * kPi * uniform(rng));
    const Vec3 wo = spherical_direction(1.5 * uniform(rng), 2 * kPi * uniform(rng));
    const Rgb expected = first.f_cos(wo, wi);
    ASSERT_LT((second.f_cos(wo, wi) - expected).abs().maxCoeff(), kFloat * (1 + expected.maxCoeff()));
    for (const double value : test::RglSlice(spectra, direction(wi)).f_cos(direction(wo))) {
      ASSERT_GE(value, 0);
      ASSERT_LE(value, expected.maxCoeff() * (1 + kFloat));
    }
  }
}

TEST_F(RglWriter, TheSameCallGivesTheSameBytes) {
  write_rgl(path(), kCoated, {.description = "coated", .layout = kSmall});
  const std::string bytes = read_file(path());
  write_rgl(path(), kCoated, {.description = "coated", .layout = kSmall});
  EXPECT_EQ(read_file(path()), bytes);
  EXPECT_EQ(test::RglFile(path()).field("description").bytes, "coated");
}

TEST_F(RglWriter, BlackAndNegativeValuesAreRead) {
  const test::FunctionBrdf dark([](const Vec3&, const Vec3&) -> Rgb { return {0, -1, 0}; }, {.non_negative = false});
  write_rgl(path(), dark, {.layout = kSmall});
  const test::RglFile file(path());
  for (const double theta : {0.0, 40.0, 85.0}) {
    const test::RglSlice slice(file, direction(spherical_direction(theta * kDegree, 0)));
    const test::Direction other = direction(spherical_direction(0.5, 1));
    EXPECT_EQ(slice.f_cos(other), (std::vector<double>{0, 0, 0}));
    EXPECT_GT(slice.pdf(other), 0);
  }
}

TEST_F(RglWriter, RefusesWhatHasTooFewNodes) {
  const auto refusal = [&](const Brdf& model, RglLayout layout) {
    return test::message_of<std::invalid_argument>([&] { write_rgl(path(), model, {.layout = layout}); });
  };
  RglLayout layout = kSmall;
  layout.nodes = 1;
  EXPECT_EQ(refusal(kConstant, layout), "write_rgl: nodes is 1, it must be at least 2");
  layout = kSmall;
  layout.azimuths = 2;
  EXPECT_EQ(refusal(Ggx({1, 1, 1}, 0.2, 0.4), layout), "write_rgl: azimuths is 2, it must be at least 3");
  EXPECT_THROW(write_rgl(folder_ / "missing" / "x.bsdf", kConstant, {.layout = kSmall}), FileError);
}

TEST_F(RglWriter, TensorFilesComeBack) {
  const std::vector<TensorField> fields = {{"name", {3}, std::vector<std::uint8_t>{1, 2, 3}},
                                           {"values", {2, 2}, std::vector<float>{1, -2, 3.5F, 4}}};
  write_tensor_file(path(), fields);
  const TensorFile file(path());
  EXPECT_EQ(file.byte("name"), 1);
  EXPECT_EQ(file.floats("values", 2).shape, (std::vector<std::size_t>{2, 2}));
  EXPECT_EQ(file.floats("values", 2).values, (std::vector<float>{1, -2, 3.5F, 4}));
  const std::vector<TensorField> bad = {{"values", {2, 2}, std::vector<float>{1}}};
  EXPECT_EQ(test::message_of<std::invalid_argument>([&] { write_tensor_file(path(), bad); }),
            "write_tensor_file: field 'values' has 1 values, its shape says 4");
}

TEST(BilinearWarp, SamplesWhatItInverts) {
  constexpr double kRounding = 1e-12;
  Rng rng(8);
  std::vector<float> density(std::size_t{2} * 5 * 7);
  for (float& value : density) value = static_cast<float>(uniform(rng));
  const BilinearWarp warp(2, 5, 7, density);
  for (int n = 0; n < 2000; ++n) {
    const int image = n % 2;
    const double x = uniform(rng);
    const Vec2 s(x, uniform(rng));
    const Vec2 back = warp.invert(warp.sample(s, image), {{image, image, 0}});
    ASSERT_LT((back - s).norm(), kRounding);
  }
  const BilinearWarp gaps(1, 3, 2, std::vector<float>{0, 0, 0, 0, 1, 1});
  for (const double s : {0.0, 0.5, 1.0}) {
    const Vec2 u = gaps.sample({s, s}, 0);
    EXPECT_GE(u.y(), 0.5);
    EXPECT_LE(u.y(), 1.0);
  }
}

TEST(Colour, PrimariesComeBackAndStayReflectances) {
  constexpr double kColour = 1e-9;
  const std::vector<double> wavelengths = written_wavelengths();
  const std::vector<Rgb> weights = rgb_weights(wavelengths), primaries = primary_spectra();
  ASSERT_EQ(weights.size(), primaries.size());
  std::array<Rgb, 3> colour = {Rgb::Zero(), Rgb::Zero(), Rgb::Zero()};
  for (std::size_t n = 0; n < weights.size(); ++n) {
    EXPECT_TRUE((primaries[n] >= 0).all());
    EXPECT_NEAR(primaries[n].sum(), 1, kColour);
    for (int c = 0; c < 3; ++c) colour[static_cast<std::size_t>(c)] += weights[n] * primaries[n][c];
  }
  for (int c = 0; c < 3; ++c) {
    const Rgb expected(c == 0 ? 1.0 : 0.0, c == 1 ? 1.0 : 0.0, c == 2 ? 1.0 : 0.0);
    EXPECT_LT((colour[static_cast<std::size_t>(c)] - expected).abs().maxCoeff(), kColour);
  }
}

/// The observer by Wyman, Sloan and Shirley 2013, "Simple Analytic Approximations to the CIE XYZ Color Matching
/// Functions", JCGT 2(2), listing 1: x, y, z.
Rgb observer(double nm) {
  const auto lobe = [nm](double height, double peak, double below, double above) {
    const double t = (nm - peak) * (nm < peak ? below : above);
    return height * std::exp(-0.5 * t * t);
  };
  return {lobe(0.362, 442.0, 0.0624, 0.0374) + lobe(1.056, 599.8, 0.0264, 0.0323) - lobe(0.065, 501.1, 0.0490, 0.0382),
          lobe(0.821, 568.8, 0.0213, 0.0247) + lobe(0.286, 530.9, 0.0613, 0.0322),
          lobe(1.217, 437.0, 0.0845, 0.0278) + lobe(0.681, 459.0, 0.0385, 0.0725)};
}

TEST(Colour, WeightsAreThoseOfTheObserverUnderDaylight) {
  constexpr double kFit = 0.03;  // of the greatest value, of the fit of the observer
  std::vector<double> wavelengths;
  for (int nm = 380; nm <= 780; nm += 5) wavelengths.push_back(nm);
  const std::vector<Rgb> weights = rgb_weights(wavelengths);
  Rgb white = Rgb::Zero();
  for (const Rgb& weight : weights) white += weight;
  EXPECT_LT((white - 1).abs().maxCoeff(), 1e-12);
  // XYZ of linear sRGB (IEC 61966-2-1). Divided by the observer it is D65: so is the quotient of two of its values.
  const auto xyz = [&](int nm) -> Rgb {
    const Rgb& rgb = weights[static_cast<std::size_t>(nm - 380) / 5];
    return Rgb(0.4124 * rgb[0] + 0.3576 * rgb[1] + 0.1805 * rgb[2], 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2],
               0.0193 * rgb[0] + 0.1192 * rgb[1] + 0.9505 * rgb[2]);
  };
  const double level = xyz(560)[1] / observer(560)[1] / 100;  // D65 is 100 at 560 nm
  for (const auto& [nm, d65] : std::vector<std::pair<int, double>>{
           {430, 86.6823}, {450, 117.008}, {480, 115.923}, {520, 104.790}, {600, 90.0062}, {640, 83.6992}}) {
    const Rgb expected = observer(nm) * (level * d65);
    EXPECT_LT((xyz(nm) - expected).abs().maxCoeff(), kFit * level * 178) << nm;
  }
}

}  // namespace
}  // namespace sklar::brdf
