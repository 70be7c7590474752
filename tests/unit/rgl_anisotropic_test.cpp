#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <variant>

#include "brdf/analytic/ggx.hpp"
#include "brdf/data/isotropy.hpp"
#include "brdf/data/material.hpp"
#include "brdf/data/rgl.hpp"
#include "brdf/data/table_brdf.hpp"
#include "copula/file.hpp"
#include "copula/random.hpp"
#include "tests/support/anisotropic_bsdf.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sklar::brdf {
namespace {

constexpr double kPi = std::numbers::pi;
// Of f cos over draws of the lobe, mean |error| / mean, 33 x 8 directions of 32 x 32 nodes. Seen: 0.0064.
constexpr double kRoundTrip = 0.01;

class AnisotropicRgl : public test::TemporaryFolder {
 protected:
  static inline const Ggx model_{{0.2, 0.5, 0.8}, 0.3, 0.6};

  [[nodiscard]] std::filesystem::path path() const { return folder_ / "brushed_rgb.bsdf"; }

  void write(const std::vector<test::TensorField>& fields) const { write_file(path(), test::tensor_file(fields)); }

  [[nodiscard]] std::shared_ptr<const RglMaterial> material(const std::vector<test::TensorField>& fields) const {
    write(fields);
    return std::make_shared<const RglMaterial>(path());
  }

  static std::vector<test::TensorField> fields(const Brdf& model, double alpha_x, double alpha_y, int folds) {
    return test::AnisotropicBsdf(model, alpha_x, alpha_y, {.folds = folds}).fields();
  }

  /// mean |f - g| cos_i / mean f cos_i over pairs along the lobe, both angles at most 80 degrees.
  static double error(const Brdf& found, const Brdf& expected) {
    Rng rng(1);
    const double low = std::cos(80 * kPi / 180);
    double difference = 0;
    double total = 0;
    for (int n = 0; n < 20000; ++n) {
      const double theta = std::acos(low + (1 - low) * uniform(rng));
      const Vec3 wo = spherical_direction(theta, 2 * kPi * uniform(rng));
      const double first = uniform(rng);
      const Vec3 wi = model_.sample(wo, {first, uniform(rng)}).wi;
      if (wi.z() < low) continue;
      const Rgb value = expected.eval(wo, wi);
      difference += (found.eval(wo, wi) - value).abs().sum() * wi.z();
      total += value.sum() * wi.z();
    }
    return difference / total;
  }

  void expect_refused(const std::vector<test::TensorField>& bad, const std::string& reason) const {
    write(bad);
    try {
      RglMaterial read(path());
      ADD_FAILURE() << "was read; expected: " << reason;
    } catch (const FileError& refusal) {
      EXPECT_EQ(refusal.what(), path().string() + ": " + reason);
    }
  }
};

TEST_F(AnisotropicRgl, ComesBackWhateverPartOfTheTurnIsStored) {
  for (const int folds : {1, 2, 4}) {
    const RglBrdf read(material(fields(model_, 0.3, 0.6, folds)));
    EXPECT_FALSE(read.traits().isotropic);
    EXPECT_EQ(read.material().folds(), folds);
    EXPECT_LT(error(read, model_), kRoundTrip) << folds;
    EXPECT_LT(median_asymmetry(read.material()), 0.01) << folds;
  }
}

TEST_F(AnisotropicRgl, HasTheSymmetriesOfTheFileAndIsReciprocal) {
  for (const int folds : {2, 4}) {
    const RglBrdf read(material(fields(model_, 0.3, 0.6, folds)));
    Rng rng(2);
    for (int n = 0; n < 2000; ++n) {
      const Vec3 wo = spherical_direction(1.5 * uniform(rng), 2 * kPi * uniform(rng));
      const Vec3 wi = spherical_direction(1.5 * uniform(rng), 2 * kPi * uniform(rng));
      const Rgb value = read.eval(wo, wi);
      ASSERT_TRUE((value == read.eval(wi, wo)).all());
      const auto flipped = [](const Vec3& w, double x, double y) { return Vec3(x * w.x(), y * w.y(), w.z()); };
      ASSERT_TRUE((value - read.eval(flipped(wo, -1, -1), flipped(wi, -1, -1))).abs().maxCoeff() <=
                  1e-6 * value.maxCoeff());
      if (folds == 4) {
        ASSERT_TRUE((value - read.eval(flipped(wo, -1, 1), flipped(wi, -1, 1))).abs().maxCoeff() <=
                    1e-6 * value.maxCoeff());
      }
    }
  }
}

TEST_F(AnisotropicRgl, TurnsWithItsAxes) {
  // A material whose axes are not x and y tells the sense of phi.
  constexpr double kTurn = 0.5;
  class Turned final : public Brdf {
   public:
    [[nodiscard]] Rgb eval(const Vec3& wo, const Vec3& wi) const override {
      return model_.eval(back_ * wo, back_ * wi);
    }
    [[nodiscard]] Traits traits() const override { return model_.traits(); }
    [[nodiscard]] std::size_t bytes() const override { return 0; }

   private:
    Eigen::Matrix3d back_ = Eigen::AngleAxisd(-kTurn, Vec3::UnitZ()).toRotationMatrix();
  };
  const Turned turned;
  const RglBrdf read(material(fields(turned, 0.45, 0.45, 1)));  // the warp need not fit the material
  EXPECT_LT(error(read, turned), 2 * kRoundTrip);
  EXPECT_GT(error(read, model_), 0.2);
}

TEST_F(AnisotropicRgl, OpenTurnIsClosed) {
  // Without the last phi_i, which repeats the first, the turn closes by itself.
  const test::AnisotropicBsdf maker(model_, 0.3, 0.6, {});
  std::vector<test::TensorField> open = maker.fields();
  for (test::TensorField& field : open) {
    if (field.name != "phi_i" && field.name != "vndf" && field.name != "rgb") continue;
    field.data.resize(field.data.size() / field.shape[0] * (field.shape[0] - 1));
    --field.shape[0];
  }
  const RglBrdf closed(material(maker.fields()));
  const RglBrdf read(material(open));
  EXPECT_LT(error(read, closed), 1e-5);
}

TEST_F(AnisotropicRgl, BecomesATableWithItsSymmetries) {
  AnisotropicGrid grid{.theta_h = 45, .phi_h = 72, .theta_d = 30, .phi_d = 18};
  for (const int folds : {1, 4}) {
    const AnisotropicTable table = resample_anisotropic(material(fields(model_, 0.3, 0.6, folds)), "brushed", grid);
    EXPECT_EQ(table.provenance, Provenance::measured);
    EXPECT_EQ(table.grid.turns, 2);
    EXPECT_TRUE(table.grid.mirrored);
    EXPECT_NEAR(table.report.isotropy_deviation, 0.40, 0.01);
    EXPECT_LT(table.report.half_turn_deviation, kRoundTrip);
    EXPECT_LT(table.report.mirror_deviation, kRoundTrip);
    EXPECT_LT(table.report.median_asymmetry, 0.01);
    EXPECT_EQ(table.report.negative_share, 0);
  }
}

TEST_F(AnisotropicRgl, MaterialsAreReadAsWhatTheyAre) {
  write(fields(model_, 0.3, 0.6, 4));
  const Material brushed = read_material(path());
  ASSERT_TRUE(std::holds_alternative<AnisotropicTable>(brushed));
  EXPECT_EQ(std::get<AnisotropicTable>(brushed).name, "brushed");
  EXPECT_LT(error(*read_material_brdf(path()), model_), kRoundTrip);
  try {
    (void)load_material(path());
    ADD_FAILURE() << "was read";
  } catch (const FileError& refusal) {
    EXPECT_EQ(refusal.what(),
              path().string() + ": is anisotropic (isotropy deviation 0.40); this needs an isotropic material");
  }

  // An isotropic material in an anisotropic file costs no fourth coordinate.
  const Ggx plain({0.2, 0.5, 0.8}, 0.3);
  write(fields(plain, 0.3, 0.3, 4));
  EXPECT_LT(isotropy_deviation(RglBrdf(std::make_shared<const RglMaterial>(path()))), 0.01);
  const Material isotropic = read_material(path());
  ASSERT_TRUE(std::holds_alternative<MeasuredTable>(isotropic));
  const MeasuredTable& table = std::get<MeasuredTable>(isotropic);
  EXPECT_EQ(table.name, "brushed");
  EXPECT_EQ(table.provenance, Provenance::measured);
  EXPECT_GT(table.report.median_asymmetry, 0);
  const TableBrdf brdf(std::make_shared<const MeasuredTable>(table));
  EXPECT_LT(error(brdf, plain), kRoundTrip);
}

TEST_F(AnisotropicRgl, MisshapenFieldsAreRefusedByName) {
  const auto good =
      test::AnisotropicBsdf(model_, 0.3, 0.6, {.azimuths = 5, .slices = 3, .warp_nodes = 4, .value_nodes = 4}).fields();
  const auto with = [&](std::size_t field, const auto& change) {
    std::vector<test::TensorField> bad = good;
    change(bad[field]);
    return bad;
  };
  const auto azimuths = [](const std::vector<float>& values) {
    return [=](test::TensorField& field) { field = test::floats("phi_i", {values.size()}, values); };
  };
  (void)material(good);
  expect_refused(with(0, azimuths({0, 1, 1, 2, 3})), "field 'phi_i' must ascend");
  expect_refused(with(0, azimuths({0, 1, 2, 3, 6.5})), "field 'phi_i' spans more than a turn");
  expect_refused(with(0, azimuths({0, 0.5, 1, 1.5, 2})),
                 "field 'phi_i' spans 0.6366197723675814 pi, expected about 2, 1 or 0.5");
  expect_refused(
      with(0, azimuths({0.5, 1, 1.5, 2, 2.07F})),
      "field 'phi_i' spans a quarter of a turn and begins at 0.15915494309189535 pi, expected a multiple of 0.5");
  expect_refused(with(0, azimuths({0, 2, 4, 6})),
                 "field 'rgb' has shape 5 x 3 x 3 x 4 x 4, expected 4 x 3 x 3 x 4 x 4");
  expect_refused(with(3,
                      [](auto& field) {
                        field.shape = {1, 16};
                      }),
                 "field 'ndf' has shape 1 x 16, expected (2 or more) x (2 or more)");
  expect_refused(with(2,
                      [](auto& field) {
                        field.shape = {16, 1};
                      }),
                 "field 'sigma' has shape 16 x 1, expected (2 or more) x (2 or more)");
  expect_refused(with(4, [](auto& field) { std::fill(field.data.end() - 64, field.data.end(), '\0'); }),
                 "field 'vndf' has a slice without mass");

  const std::string bytes = test::tensor_file(good);
  Rng rng(5);
  for (int n = 0; n < 1000; ++n) {  // a damaged file is read or refused, nothing else
    std::string damaged = bytes;
    for (int k = 0; k < 3; ++k) damaged[rng() % 330] = static_cast<char>(rng());
    write_file(path(), damaged);
    try {
      const Rgb value = RglBrdf(std::make_shared<const RglMaterial>(path())).eval(Vec3(0.6, 0, 0.8), Vec3(0, 0.6, 0.8));
      EXPECT_FALSE(value.isNaN().any());
    } catch (const FileError&) {
    }
  }
}

}  // namespace
}  // namespace sklar::brdf
