/// Files as this and earlier versions of the program wrote them: each is read to the same numbers for ever.
///
/// KIND_VERSION[_WHAT].EXT in this folder is what the program wrote. The CSV of the same name beside it holds points
/// and, in its last columns, the values of the file there; a file without points has one row. To add a file, for a new
/// version or for what the format can hold since: write a small one with the program, put the points into the CSV, and
/// run this test, which prints the rest of it; check these numbers by another way before they are stored. A file that
/// is there is never changed: where a test of it fails, the reader is at fault.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <set>

#include "brdf/data/rgl.hpp"
#include "brdf/model/model_binary.hpp"
#include "brdf/model/model_io.hpp"
#include "brdf/render/scene_io.hpp"
#include "brdf/study/model_row.hpp"
#include "copula/error.hpp"
#include "copula/file.hpp"
#include "copula/inference/csv.hpp"
#include "copula/inference/model_io.hpp"
#include "copula/symbolic/formula_family.hpp"
#include "families/registry.hpp"
#include "tests/support/message.hpp"
#include "tests/support/refined_cases.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sklar {
namespace {
namespace fs = std::filesystem;
using brdf::Vec3;

constexpr double kExact = 1e-13;  ///< relative; different mathematical libraries round differently

/// What a file was read as.
struct Content {
  std::vector<std::string> names;              ///< of the values
  std::function<Points(const PointsRef&)> at;  ///< points n x k, values n x names
  std::string again = {};                      ///< written by this version; empty where it writes no such file
  double tolerance = kExact;                   ///< relative, of the values
  double lowest = -std::numeric_limits<double>::infinity();  ///< of any value of this kind of file
};

struct Kind {
  int newest;
  Content (*read)(const fs::path& file);
};

/// Density and distribution function on the unit cube.
Content of_copula(const CopulaPtr& copula) {
  return {.names = {"log_pdf", "cdf"}, .at = [copula](const PointsRef& points) {
            // A damaged file may hold a copula of another dimension.
            const Points u = points.cols() == copula->dim() ? Points(points) : Points::Constant(1, copula->dim(), 0.3);
            Points values(u.rows(), 2);
            values << copula->log_pdf(u), copula->cdf(u);
            return values;
          }};
}

/// With margins, of the joint distribution.
Content read_copula(const fs::path& file) {
  const CopulaModel model = read_model(file, families::all());
  Content content = of_copula(make_copula(model, families::all()));
  content.again = to_json(model);
  if (model.margins.empty()) return content;
  const auto joint = std::make_shared<const JointDistribution>(make_joint(model, families::all()));
  content.at = [joint](const PointsRef& x) {
    Points values(x.rows(), 2);
    values << joint->conditional_cdf(x), joint->cdf(x);
    return values;
  };
  content.names[0] = "conditional_cdf";
  return content;
}

Content read_family(const fs::path& file) {
  const symbolic::FamilyDefinition definition = symbolic::parse_definition(read_file(file), file.string());
  Content content;
  try {
    const FamilyInfo family = symbolic::make_family(definition);
    content = of_copula(family.make(3, family.examples.at(1)));
  } catch (const std::logic_error& error) {  // for the caller to say of which file
    throw FileError(file.string(), error.what());
  }
  content.again = to_json(definition);
  return content;
}

Content of_brdf(const std::function<brdf::Rgb(const Vec3&, const Vec3&)>& value) {
  return {.names = {"r", "g", "b"},
          .at =
              [value](const PointsRef& points) {
                Points values(points.rows(), 3);
                for (Index i = 0; i < points.rows(); ++i) {
                  values.row(i) = value(points.row(i).head<3>().matrix(), points.row(i).tail<3>().matrix());
                }
                return values;
              },
          .lowest = 0};
}

Content read_stored(const fs::path& file) {
  const brdf::StoredBrdf stored = brdf::read_brdf(file);
  Content content = of_brdf([brdf = stored.brdf()](const Vec3& wo, const Vec3& wi) { return brdf->eval(wo, wi); });
  if (const auto* refined = std::get_if<std::shared_ptr<const brdf::RefinedBrdf>>(&stored.model)) {
    content = of_brdf([brdf = *refined](const Vec3& wo, const Vec3& wi) {  // in double
      return brdf->at(coordinates(brdf->structure(), wo, wi));
    });
  } else if (std::holds_alternative<std::shared_ptr<const brdf::AnisotropicModel>>(stored.model)) {
    content.tolerance = test::kSinglePrecision;
  }
  content.again = brdf::is_binary_path(file) ? to_binary(stored) : to_json(stored);
  return content;
}

Content read_rgl(const fs::path& file) {
  const auto brdf = std::make_shared<const brdf::RglBrdf>(std::make_shared<const brdf::RglMaterial>(file));
  return of_brdf([brdf](const Vec3& wo, const Vec3& wi) { return brdf->eval(wo, wi); });
}

/// Named numbers in place of values at points.
class Fields {
 public:
  void add(const std::string& name, double value) {
    names_.push_back(name);
    values_.push_back(value);
  }
  void add(const std::string& name, const Eigen::Ref<const Eigen::ArrayXd>& values) {
    for (Index i = 0; i < values.size(); ++i) add(name + "_" + std::to_string(i + 1), values[i]);
  }
  [[nodiscard]] Content content() const {
    return {.names = names_, .at = [values = values_](const PointsRef&) {
              return Points(Eigen::Map<const Column>(values.data(), static_cast<Index>(values.size())).transpose());
            }};
  }

 private:
  std::vector<std::string> names_;
  std::vector<double> values_;
};

/// A sphere by its centre and radius, a mesh by its bounds; what the material reflects at one pair of directions.
void add_object(const std::string& name, const brdf::Object& object, Fields& fields) {
  if (const auto* sphere = std::get_if<brdf::Sphere>(&object.shape)) {
    fields.add(name + "_centre", sphere->centre.array());
    fields.add(name + "_radius", sphere->radius);
  } else {
    const auto& vertices = std::get<brdf::MeshPtr>(object.shape)->vertices;
    Vec3 low = vertices.front(), high = low;
    for (const Vec3& vertex : vertices) low = low.cwiseMin(vertex), high = high.cwiseMax(vertex);
    fields.add(name + "_low", low.array());
    fields.add(name + "_high", high.array());
  }
  fields.add(name + "_emission", object.emission);
  if (object.material) fields.add(name + "_material", object.material->eval(Vec3(0.6, 0, 0.8), Vec3(0, 0.28, 0.96)));
}

Content read_scene(const fs::path& file) {
  const brdf::Scene scene = brdf::read_scene(file, {});
  Fields fields;
  fields.add("width", scene.width);
  fields.add("height", scene.height);
  fields.add("depth", scene.depth);
  fields.add("exposure", scene.exposure);
  fields.add("position", scene.camera.position.array());
  fields.add("target", scene.camera.target.array());
  fields.add("up", scene.camera.up.array());
  fields.add("field_of_view", scene.camera.field_of_view);
  if (scene.background) fields.add("background", *scene.background);
  if (scene.environment) fields.add("environment", scene.environment->radiance(Vec3(0, 1, 0)));
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const std::string name = "light_" + std::to_string(i + 1);
    fields.add(name + "_direction", scene.lights[i].direction.array());
    fields.add(name + "_irradiance", scene.lights[i].irradiance);
  }
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    add_object("object_" + std::to_string(i + 1), scene.objects[i], fields);
  }
  return fields.content();
}

Content read_row(const fs::path& file) {
  const brdf::ModelRow row = brdf::model_row_from_json(read_file(file), file.string());
  Fields fields;
  fields.add("budget", row.budget);
  fields.add("bytes", row.bytes);
  fields.add("fit_s", row.fit_s);
  fields.add("rel_l2", row.rel_l2);
  fields.add("delta_e_2000", row.delta_e_2000);
  fields.add("reciprocity_error", row.reciprocity_error);
  Content content = fields.content();
  content.again = to_json(row);
  return content;
}

const std::map<std::string, Kind> kKinds = {{"binary", {brdf::kBinaryVersion, read_stored}},
                                            {"brdf", {brdf::kBrdfModelVersion, read_stored}},
                                            {"copula", {kModelVersion, read_copula}},
                                            {"family", {symbolic::kFamilyVersion, read_family}},
                                            {"rgl", {1, read_rgl}},
                                            {"row", {brdf::kModelRowVersion, read_row}},
                                            {"scene", {brdf::kSceneVersion, read_scene}}};

struct GoldenFile {
  fs::path path;
  Kind kind;
  std::string kind_name;
  int version;
  std::string bytes;
  Table table;  ///< the CSV beside it

  [[nodiscard]] Content read() const { return kind.read(path); }
  [[nodiscard]] Points points(const Content& content) const {
    return table.values.leftCols(table.values.cols() - static_cast<Index>(content.names.size()));
  }
};

class GoldenFiles : public test::TemporaryFolder {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    for (const auto& entry : fs::directory_iterator(SKLAR_GOLDEN_FILES)) {
      const fs::path& path = entry.path();
      if (path.extension() == ".csv" || path.extension() == ".cpp") continue;
      const std::string name = path.stem().string();
      const std::size_t bar = name.find('_');
      ASSERT_TRUE(bar != std::string::npos && kKinds.contains(name.substr(0, bar))) << path;
      files_.push_back({.path = path,
                        .kind = kKinds.at(name.substr(0, bar)),
                        .kind_name = name.substr(0, bar),
                        .version = std::stoi(name.substr(bar + 1)),
                        .bytes = read_file(path),
                        .table = read_csv(fs::path(path).replace_extension(".csv"))});
    }
  }

  /// A file of these bytes in place of the golden one.
  [[nodiscard]] fs::path written(const GoldenFile& file, const std::string& bytes) const {
    const fs::path path = folder_ / file.path.filename();
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
  }

  [[nodiscard]] std::string refusal(const GoldenFile& file, const std::string& bytes) const {
    return test::message_of<FileError>([&] { (void)file.kind.read(written(file, bytes)); });
  }

  /// A FileError, or values that such a file can have.
  void expect_refused_or_sound(const GoldenFile& file, const std::string& bytes, const std::string& what) const {
    try {
      const Content content = file.kind.read(written(file, bytes));
      if (file.kind_name == "row" || file.kind_name == "scene") return;  // any number is one
      const Points values = content.at(file.points(content));
      EXPECT_TRUE((values >= content.lowest).all()) << file.path << " " << what << "\n" << values;
    } catch (const FileError&) {
    } catch (const std::exception& error) {
      ADD_FAILURE() << file.path << " " << what << ": " << error.what();
    }
  }

  std::vector<GoldenFile> files_;
};

bool agree(double found, double expected, double tolerance) {
  if (std::isnan(expected)) return std::isnan(found);
  return found == expected || std::abs(found - expected) <= tolerance * std::abs(expected);
}

TEST_F(GoldenFiles, AreReadAsTheNumbersBesideThem) {
  for (const GoldenFile& file : files_) {
    const Content content = file.read();
    std::vector<std::string> names = file.table.names;
    const bool complete = names.size() >= content.names.size() &&
                          std::equal(content.names.rbegin(), content.names.rend(), names.rbegin());
    const Points points = complete ? file.points(content) : file.table.values;
    const Points values = content.at(points);
    if (!complete) {
      Points all(values.rows(), points.cols() + values.cols());
      all << points, values;
      names.insert(names.end(), content.names.begin(), content.names.end());
      ADD_FAILURE() << file.path << " has no values beside it; it is read as\n" << to_csv(names, all);
      continue;
    }
    const Points expected = file.table.values.rightCols(values.cols());
    for (Index i = 0; i < values.size(); ++i) {
      EXPECT_TRUE(agree(values(i), expected(i), content.tolerance))
          << file.path << " row " << i % values.rows() + 1 << ", "
          << content.names[static_cast<std::size_t>(i / values.rows())] << ": " << to_text(values(i)) << ", expected "
          << to_text(expected(i));
    }
  }
}

/// Where the bytes have a version, that of the file itself first.
std::vector<std::size_t> version_places(const GoldenFile& file) {
  std::vector<std::size_t> result;
  if (file.kind_name == "binary") result.push_back(brdf::kBinaryMagic.size());
  if (file.kind_name == "rgl") result.push_back(std::string("tensor_file").size() + 1);
  const std::string field = "\"version\":";
  for (std::size_t at = 0; (at = file.bytes.find(field, at)) != std::string::npos;) {
    at = file.bytes.find_first_not_of(' ', at + field.size());
    result.push_back(at);
  }
  return result;
}

/// The same version in the same form, a digit or a byte.
char version_byte(char in_file, int version) {
  return static_cast<char>(in_file >= '0' ? '0' + version : version);
}

TEST_F(GoldenFiles, AreWrittenAgainAsTheyAre) {
  for (const GoldenFile& file : files_) {
    const std::string again = file.read().again;
    const std::size_t place = version_places(file).at(0);
    if (again.empty() || again.at(place) != file.bytes[place]) continue;  // written in a newer version
    EXPECT_EQ(again, file.bytes) << file.path;
  }
}

TEST_F(GoldenFiles, AreThereForEveryVersion) {
  std::set<std::pair<std::string, int>> found;
  for (const GoldenFile& file : files_) {
    const char in_file = file.bytes.at(version_places(file).at(0));
    EXPECT_EQ(in_file, version_byte(in_file, file.version)) << file.path;
    found.emplace(file.kind_name, file.version);
  }
  for (const auto& [name, kind] : kKinds) {
    for (int version = 1; version <= kind.newest; ++version) {
      EXPECT_TRUE(found.contains({name, version})) << "no file of kind " << name << " and version " << version;
    }
  }
}

TEST_F(GoldenFiles, OfANewerVersionAreRefused) {
  const std::map<std::string, std::string> allowed = {{"binary", ", this program reads 1"},
                                                      {"rgl", ".0, expected 1.0"}};
  for (const GoldenFile& file : files_) {
    const std::vector<std::size_t> places = version_places(file);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const int version = i == 0 ? file.kind.newest + 1 : 9;  // those within are of kinds of their own
      std::string bytes = file.bytes;
      bytes[places[i]] = version_byte(bytes[places[i]], version);
      const std::string message = refusal(file, bytes);
      const bool own = i == 0 && allowed.contains(file.kind_name);
      EXPECT_TRUE(message.starts_with((folder_ / file.path.filename()).string() + ": ")) << message;
      EXPECT_NE(message.find("has version " + std::to_string(version) +
                             (own ? allowed.at(file.kind_name) : "; this program reads versions 1 to ")),
                std::string::npos)
          << message;
    }
  }
}

TEST_F(GoldenFiles, CutShortAreRefused) {
  constexpr std::size_t kCuts = 16;
  for (const GoldenFile& file : files_) {
    const std::size_t size = file.bytes.size() - (file.bytes.ends_with('\n') ? 1 : 0);
    for (std::size_t i = 0; i <= kCuts; ++i) {
      const std::string bytes = file.bytes.substr(0, std::min(size * i / kCuts, size - 1));
      EXPECT_FALSE(refusal(file, bytes).empty()) << file.path << " cut to " << bytes.size() << " of " << size;
    }
  }
}

TEST_F(GoldenFiles, WithAWrongByteAreRefusedOrSound) {
  constexpr std::size_t kPlaces = 24;
  for (const GoldenFile& file : files_) {
    for (std::size_t i = 0; i < kPlaces; ++i) {
      const std::size_t place = file.bytes.size() * i / kPlaces;
      const std::array<int, 3> wrong = {file.bytes[place] ^ 1, file.bytes[place] ^ 0x80, '9'};
      std::string bytes = file.bytes;
      bytes[place] = static_cast<char>(wrong[i % wrong.size()]);
      expect_refused_or_sound(file, bytes, "byte " + std::to_string(place) + " = " + std::to_string(bytes[place]));
    }
  }
}

}  // namespace
}  // namespace sklar
