#include "brdf/data/rgl.hpp"

#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <numbers>

#include "brdf/data/material.hpp"
#include "brdf/data/table_brdf.hpp"
#include "brdf/geometry/frame.hpp"
#include "copula/error.hpp"
#include "copula/file.hpp"
#include "copula/random.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/tensor_writer.hpp"

namespace sklar::brdf {
namespace {
namespace fs = std::filesystem;

constexpr double kPi = std::numbers::pi;
constexpr double kFloat = 1e-6;         // values are stored in single precision
constexpr double kInterpolated = 0.01;  // bilinear error of cos(theta_o) on 64 nodes, relative to 1

/// A material of T x n x n nodes whose warp is u -> (u_x^2, u_y) or, with flat density, the identity.
struct Maker {
  int slices = 3;
  int nodes = 4;
  bool flat = true;
  std::uint8_t jacobian = 1;
  std::function<double(int channel, double theta_i, double x, double y)> rgb = [](int, double, double, double) {
    return 1.0;
  };
  double ndf = 1 / kPi;
  std::function<double(double theta)> sigma = [](double) { return 1.0; };

  [[nodiscard]] std::vector<test::TensorField> fields() const {
    const auto T = static_cast<std::uint64_t>(slices);
    const auto n = static_cast<std::uint64_t>(nodes);
    std::vector<float> theta_i, profile, density, values;
    const auto at = [&](int k) { return static_cast<double>(k) / (nodes - 1); };
    for (int t = 0; t < slices; ++t) theta_i.push_back(static_cast<float>(kPi / 2 * t / (slices - 1)));
    for (int copy = 0; copy < 2; ++copy) {
      for (int k = 0; k < nodes; ++k) profile.push_back(static_cast<float>(sigma(at(k) * at(k) * kPi / 2)));
    }
    for (int t = 0; t < slices; ++t) {
      for (int k = 0; k < nodes * nodes; ++k) density.push_back(flat ? 1.0F : static_cast<float>(at(k % nodes)));
      for (int channel = 0; channel < 3; ++channel) {
        for (int k = 0; k < nodes * nodes; ++k) {
          values.push_back(
              static_cast<float>(rgb(channel, theta_i[static_cast<std::size_t>(t)], at(k % nodes), at(k / nodes))));
        }
      }
    }
    return {test::floats("phi_i", {1}, {0.0F}),
            test::floats("theta_i", {T}, theta_i),
            test::floats("sigma", {2, n}, profile),
            test::floats("ndf", {2, n}, std::vector<float>(2 * n, static_cast<float>(ndf))),
            test::floats("vndf", {1, T, n, n}, density),
            test::floats("rgb", {1, T, 3, n, n}, values),
            {"jacobian", 1, {1}, std::string(1, static_cast<char>(jacobian))}};
  }
};

/// cos(theta_o) of the direction that node (x, y) of a flat warp stands for; 0 below the horizon.
double cos_theta_o(double theta_i, double x, double y) {
  const Vec3 half = spherical_direction(x * x * kPi / 2, 2 * kPi * y - kPi);
  const Vec3 wi = spherical_direction(theta_i, 0);
  return std::max(2 * wi.dot(half) * half.z() - wi.z(), 0.0);
}

/// f_r = (0.2, 0.5, 0.8) / pi, with the shadowing of a constant density of normals.
Maker lambertian() {
  Maker maker;
  maker.slices = 32;
  maker.nodes = 64;
  maker.sigma = [](double theta) { return 0.5 * (1 + std::cos(theta)); };
  maker.rgb = [](int channel, double theta_i, double x, double y) {
    return (0.2 + 0.3 * channel) / kPi * cos_theta_o(theta_i, x, y) * 2 * (1 + std::cos(theta_i)) * kPi;
  };
  return maker;
}

class Rgl : public test::TemporaryFolder {
 protected:
  [[nodiscard]] RglMaterial material(const std::vector<test::TensorField>& fields) const {
    write_file(folder_ / "x.bsdf", test::tensor_file(fields));
    return RglMaterial(folder_ / "x.bsdf");
  }

  void expect_refused(const std::string& bytes, const std::string& reason) const {
    const fs::path path = folder_ / "x.bsdf";
    write_file(path, bytes);
    try {
      RglMaterial read(path);
      ADD_FAILURE() << "was read; expected: " << reason;
    } catch (const FileError& error) {
      EXPECT_EQ(error.what(), path.string() + ": " + reason);
    }
  }
  void expect_refused(const std::vector<test::TensorField>& fields, const std::string& reason) const {
    expect_refused(test::tensor_file(fields), reason);
  }
};

TEST_F(Rgl, LambertianComesBack) {
  const RglMaterial lambert = material(lambertian().fields());
  Rng rng(11);
  for (int n = 0; n < 20000; ++n) {
    const Vec3 wi = spherical_direction(1.2 * uniform(rng), 2 * kPi * uniform(rng));
    const Vec3 wo = spherical_direction(1.2 * uniform(rng), 2 * kPi * uniform(rng));
    const Rgb found = lambert.f_cos(wo, wi) * kPi;
    for (int channel = 0; channel < 3; ++channel) {
      const double albedo = 0.2 + 0.3 * channel;
      ASSERT_NEAR(found[channel] / albedo, wo.z(), kInterpolated) << wi.transpose() << " | " << wo.transpose();
    }
  }
}

TEST_F(Rgl, WarpFollowsTheDensityOfNormals) {
  // Density u_x: s_x = u_x^2 = 2 theta_m / pi, which bilinear nodes hold exactly.
  Maker maker;
  maker.flat = false;
  maker.jacobian = 0;
  maker.rgb = [](int channel, double, double x, double y) { return channel == 0 ? x : y; };
  const RglMaterial plain = material(maker.fields());
  const Vec3 wi = spherical_direction(0.7, 2.0);
  for (const double theta_m : {1e-6, 0.1, 0.5, 0.8}) {
    for (const double phi_m : {-3.0, -0.4, 0.0, 1.3}) {
      const Vec3 half = spherical_direction(theta_m, 2.0 + phi_m);
      const Rgb s = plain.f_cos(2 * wi.dot(half) * half - wi, wi);
      EXPECT_NEAR(s[0], 2 * theta_m / kPi, kFloat);
      EXPECT_NEAR(s[1], (phi_m + kPi) / (2 * kPi), kFloat);
    }
  }
}

TEST_F(Rgl, ValuesInterpolateInThetaI) {
  Maker maker;
  maker.jacobian = 0;
  maker.rgb = [](int channel, double theta_i, double, double) { return (1 + channel) * theta_i; };
  const RglMaterial plain = material(maker.fields());
  for (const double theta_i : {0.0, 0.3, kPi / 4, 1.5}) {
    const Rgb value = plain.f_cos(spherical_direction(0.2, 1), spherical_direction(theta_i, 0.3));
    for (int channel = 0; channel < 3; ++channel) EXPECT_NEAR(value[channel], (1 + channel) * theta_i, kFloat * 10);
  }
}

TEST_F(Rgl, ResamplingSymmetrisesClampsAndReports) {
  Maker maker = lambertian();
  maker.rgb = [stored = maker.rgb](int channel, double theta_i, double x, double y) {
    return channel == 0 ? -1.0 : stored(channel, theta_i, x, y);
  };
  const MeasuredTable table = resample(material(maker.fields()), "lambertian");
  EXPECT_EQ(table.name, "lambertian");
  EXPECT_EQ(table.provenance, Provenance::measured);
  EXPECT_NEAR(table.report.negative_share, 1.0 / 3, 1e-12);
  EXPECT_LT(table.report.mirror_asymmetry, 1e-5);
  EXPECT_LT(table.report.median_asymmetry, kInterpolated);
  EXPECT_NEAR(1 - static_cast<double>(table.valid_cells()) / Grid::cells, 0.248, 0.0005);
  for (std::size_t cell = 0; cell < Grid::cells; ++cell) ASSERT_EQ(table.values[0][cell], 0);
  const auto centre = static_cast<std::size_t>(Grid::index(30, 40, 60));
  EXPECT_NEAR(table.values[1][centre] * kPi / 0.5, 1, kInterpolated);
  EXPECT_NEAR(table.values[2][centre] * kPi / 0.8, 1, kInterpolated);
}

TEST_F(Rgl, MisshapenFieldsAreRefusedByName) {
  const std::vector<test::TensorField> good = Maker().fields();
  const auto with = [&](std::size_t field, const auto& change) {
    std::vector<test::TensorField> fields = good;
    change(fields[field]);
    return fields;
  };
  const auto without = [&](std::size_t field) {
    std::vector<test::TensorField> fields = good;
    fields.erase(fields.begin() + static_cast<std::ptrdiff_t>(field));
    return fields;
  };
  const auto set = [](float value) {
    return [value](test::TensorField& field) { std::memcpy(field.data.data() + 4, &value, sizeof value); };
  };
  (void)material(good);
  for (std::size_t n = 0; n < good.size(); ++n) expect_refused(without(n), "has no field '" + good[n].name + "'");
  expect_refused(with(5, [](auto& field) { field.name = "wavelengths"; }),
                 "field 'wavelengths' has 5 dimensions, expected 1");
  expect_refused(with(1, set(3)), "field 'theta_i' must ascend within [0, pi/2]");
  expect_refused(with(1, set(-1)), "field 'theta_i' must ascend within [0, pi/2]");
  expect_refused(with(2, set(0)), "field 'sigma' holds 0.000000, expected more than 0");
  expect_refused(with(3, set(-1)), "field 'ndf' holds -1.000000, expected 0 or more");
  expect_refused(with(4, set(-1)), "field 'vndf' holds -1.000000, expected 0 or more");
  expect_refused(with(4, [](auto& field) { std::fill(field.data.begin(), field.data.end(), '\0'); }),
                 "field 'vndf' has a slice without mass");
  expect_refused(with(5, set(std::numeric_limits<float>::quiet_NaN())), "field 'rgb' holds nan at index 1");
  expect_refused(with(5, [](auto& field) { field.type = 11; }), "field 'rgb' ends past the file (has 1121 bytes)");
  expect_refused(with(5, [](auto& field) { field.type = 5; }), "field 'rgb' has type uint32, expected float32");
  expect_refused(with(5, [](auto& field) { field.type = 12; }), "field 'rgb' has type 12, expected 1 to 11");
  expect_refused(with(5, [](auto& field) { field.shape = {3, 3, 4, 4}; }), "field 'rgb' has 4 dimensions, expected 5");
  expect_refused(with(5,
                      [](auto& field) {
                        field.shape = {1, 3, 3, 16, 1};
                      }),
                 "field 'rgb' has shape 1 x 3 x 3 x 16 x 1, expected 1 x 3 x 3 x 16 x 2");
  expect_refused(with(5, [](auto& field) { field.shape = {1, 3, 3, 0, 4}; }), "field 'rgb' is empty");
  expect_refused(with(4,
                      [](auto& field) {
                        field.shape = {1, 2, 4, 4};
                      }),
                 "field 'vndf' has shape 1 x 2 x 4 x 4, expected 1 x 3 x 4 x 4");
  expect_refused(with(6, [](auto& field) { field.name = "rgb"; }), "field 'rgb' occurs twice");
}

TEST_F(Rgl, HostileFilesAreRefused) {
  const std::string good = test::tensor_file(Maker().fields());
  const std::size_t size = good.size();
  expect_refused("", "is not a tensor file (does not begin with 'tensor_file')");
  expect_refused(std::string(2000, 'x'), "is not a tensor file (does not begin with 'tensor_file')");
  std::string bytes = good;
  bytes[12] = 2;
  expect_refused(bytes, "has version 2.0, expected 1.0");
  bytes = good;
  std::memset(bytes.data() + 14, 0xff, 4);  // the number of fields
  EXPECT_THROW(
      {
        write_file(folder_ / "x.bsdf", bytes);
        RglMaterial read(folder_ / "x.bsdf");
      },
      FileError);

  auto fields = Maker().fields();
  fields[5].shape = {1, std::uint64_t{1} << 62, 3, std::uint64_t{1} << 62, 16};  // the product wraps to a small number
  expect_refused(fields, "field 'rgb' ends past the file (has " + std::to_string(size) + " bytes)");
  fields[5].shape = {0, std::uint64_t{1} << 62, 3, 4, 4};
  expect_refused(fields, "field 'rgb' is empty");

  for (std::size_t length = 0; length < size; ++length) {
    write_file(folder_ / "x.bsdf", good.substr(0, length));
    EXPECT_THROW(RglMaterial(folder_ / "x.bsdf"), FileError) << length;
  }
  Rng rng(5);
  for (int n = 0; n < 1000; ++n) {  // a damaged file is read or refused, nothing else
    bytes = good;
    for (int k = 0; k < 3; ++k) bytes[rng() % 300] = static_cast<char>(rng());
    write_file(folder_ / "x.bsdf", bytes);
    try {
      const Rgb value = RglMaterial(folder_ / "x.bsdf").f_cos(Vec3(0.6, 0, 0.8), Vec3(0, 0.6, 0.8));
      EXPECT_FALSE(value.isNaN().any());
    } catch (const FileError&) {
    }
  }
}

TEST(BilinearWarp, InvertsTheIntegralOfTheDensity) {
  constexpr int kRows = 4;
  constexpr int kColumns = 5;
  Rng rng(6);
  std::vector<float> density(std::size_t{2} * kRows * kColumns);
  for (float& value : density) value = static_cast<float>(uniform(rng));
  const BilinearStack image(2, kRows, kColumns, density);
  const BilinearWarp warp(2, kRows, kColumns, density);
  // Midpoint sums over a grid that the nodes divide: exact along x and y up to the curvature 1/steps^2.
  constexpr int kSteps = 1200;
  const auto along = [&](double to, const std::function<double(double)>& f) {
    const int cells = static_cast<int>(std::lround(to * kSteps));
    double sum = 0;
    for (int k = 0; k < cells; ++k) sum += f((k + 0.5) / kSteps) / kSteps;
    return sum;
  };
  for (const int slice : {0, 1}) {
    const Between only{slice, slice, 0};
    const auto row = [&](double y) { return along(1, [&](double x) { return image.at({x, y}, {only}); }); };
    const double total = along(1, row);
    for (const double y : {0.0, 0.25, 0.6, 1.0}) {
      const double below = along(y, row) / total;
      for (const double x : {0.0, 0.1, 0.55, 1.0}) {
        const double part = along(x, [&](double at) { return image.at({at, y}, {only}); }) / row(y);
        const Vec2 s = warp.invert({x, y}, {only});
        EXPECT_NEAR(s.x(), part, 1e-6);
        EXPECT_NEAR(s.y(), below, 1e-6);
        EXPECT_NEAR(warp.invert({x, y}, {{0, 1, static_cast<double>(slice)}}).x(), part, 1e-6);
      }
    }
  }
}

TEST(BilinearWarp, RefusesNoMassAndSurvivesEmptyRows) {
  EXPECT_THROW(BilinearWarp(1, 2, 2, std::vector<float>(4, 0.0F)), std::invalid_argument);
  const BilinearWarp warp(1, 3, 2, std::vector<float>{0, 0, 0, 0, 1, 1});
  EXPECT_EQ(warp.invert({0.3, 0.2}, {{0, 0, 0}}), Vec2(0.3, 0.0));
}

TEST_F(Rgl, ExtensionDecides) {
  try {
    (void)load_material(folder_ / "x.txt");
    ADD_FAILURE();
  } catch (const FileError& error) {
    EXPECT_EQ(
        error.what(),
        (folder_ / "x.txt").string() +
            ": has extension '.txt', expected .binary (MERL), .bsdf (RGL), .brdf (pbrt-v2) or .csv (wi, wo, rgb)");
  }
  EXPECT_THROW((void)load_material(folder_ / "missing.bsdf"), FileError);
  EXPECT_THROW((void)load_material(folder_ / "missing.binary"), FileError);
}

TEST(RglFiles, MeasuredMaterials) {
  const char* data = std::getenv("SKLAR_TEST_DATA");
  if (data == nullptr) GTEST_SKIP() << "SKLAR_TEST_DATA is not set: no measured materials to read";
  int files = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(data) / "materials" / "rgl")) {
    if (entry.path().extension() != ".bsdf") continue;
    ++files;
    const MeasuredTable table = load_material(entry.path());
    SCOPED_TRACE(table.name);
    EXPECT_FALSE(table.name.ends_with("_rgb"));
    EXPECT_NO_THROW(require_table("test", table));
    EXPECT_NEAR(1 - static_cast<double>(table.valid_cells()) / Grid::cells, 0.248, 0.0005);
    EXPECT_LT(table.report.mirror_asymmetry, 1e-6);
    EXPECT_GT(table.report.median_asymmetry, 0.015);
    EXPECT_LT(table.report.median_asymmetry, 0.40);
    if (table.name == "chm_mint") {
      EXPECT_NEAR(table.report.negative_share, 0.21, 0.005);
    }
    if (table.name == "paper_white") {
      EXPECT_EQ(table.report.negative_share, 0);
    }

    const TableBrdf brdf(std::make_shared<const MeasuredTable>(table));
    const Vec3 wo = spherical_direction(kPi / 4, 0);
    Rgb albedo = Rgb::Zero();
    constexpr int kSteps = 100;
    for (int k = 0; k < kSteps * kSteps; ++k) {
      const int row = k / kSteps, column = k % kSteps;
      const Vec2 w((row + 0.5) / kSteps, (column + 0.5) / kSteps);
      const Vec3 wi = spherical_direction(std::asin(std::sqrt(w.x())), 2 * kPi * w.y());
      albedo += brdf.eval(wo, wi) * (kPi / (kSteps * kSteps));
    }
    EXPECT_TRUE((albedo > 0.02).all() && (albedo < 1).all()) << albedo.transpose();
  }
  EXPECT_GT(files, 0);
}

}  // namespace
}  // namespace sklar::brdf
