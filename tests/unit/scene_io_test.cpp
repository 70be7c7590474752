#include "brdf/render/scene_io.hpp"

#include <array>
#include <stdexcept>

#include "brdf/analytic/lambert.hpp"
#include "brdf/analytic/registry.hpp"
#include "brdf/render/nearest_name.hpp"
#include "copula/error.hpp"
#include "copula/file.hpp"
#include "tests/support/message.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sklar::brdf {
namespace {

constexpr const char* kScene = R"({
  "format": "sklar scene", "version": 1,
  "size": [320, 200], "depth": 5, "exposure": 1.5, "background": 0.25,
  "camera": {"position": [0, 1, 6], "target": [0, 0.5, 0], "up": [0, 2, 0], "field_of_view": 30},
  "environment": {"file": "sky.exr", "scale": 2},
  "lights": [{"direction": [1, 2, 3], "irradiance": [3, 2, 1]}],
  "materials": {
    "main": {"given": 1},
    "gold": {"model": "ggx", "f0": [1, 0.8, 0.3], "alpha": 0.2},
    "paint": {"model": "ggx", "f0": 0.04, "alpha": 0.1, "diffuse": [0.5, 0.1, 0.1]}
  },
  "objects": [
    {"name": "ball", "shape": "sphere", "centre": [0, 1, 0], "radius": 0.5, "material": "main"},
    {"shape": "rectangle", "corner": [-5, 0, -5], "side_a": [0, 0, 10], "side_b": [10, 0, 0], "material": "paint"},
    {"shape": "box", "size": [1, 2, 3], "at": [0, 1, 0], "turn": 90, "scale": 2, "material": "gold"},
    {"shape": "torus", "ring": 1, "tube": 0.25, "material": "gold"},
    {"shape": "revolution", "profile": [[0.2, 0], [0.3, 0.5], [0.1, 1]], "material": "gold"},
    {"shape": "mesh", "file": "triangle.obj", "at": [1, 0, 0], "emission": [1, 2, 3]}
  ]
})";

class SceneFile : public test::TemporaryFolder {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    Image sky(2, 1);
    sky.rgb = {1, 1, 1, 0.5, 0.25, 0.125};
    write_exr(folder_ / "sky.exr", sky);
    write_file(folder_ / "triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  }

  [[nodiscard]] Scene read(std::string_view text) const {
    write_file(folder_ / "scene.json", text);
    return read_scene(folder_ / "scene.json", given_);
  }

  /// What is said of the scene with a part of its text replaced, without the folder.
  [[nodiscard]] std::string refused(const std::string& from, const std::string& to) const {
    std::string text = kScene;
    const std::size_t at = text.find(from);
    if (at == std::string::npos) return "the test replaces nothing";
    text.replace(at, from.size(), to);
    const std::string message = test::message_of<FileError>([&] { (void)read(text); });
    EXPECT_EQ(message.find('\n'), std::string::npos);
    return message.empty() ? message : message.substr(folder_.string().size() + 1);
  }

  std::array<BrdfPtr, 1> given_{std::make_shared<const Lambert>(Rgb::Constant(0.5))};
};

TEST_F(SceneFile, EveryKeyIsRead) {
  const Scene scene = read(kScene);
  EXPECT_EQ(scene.width, 320);
  EXPECT_EQ(scene.height, 200);
  EXPECT_EQ(scene.depth, 5);
  EXPECT_EQ(scene.exposure, 1.5);
  EXPECT_TRUE((*scene.background == 0.25).all());
  EXPECT_EQ(scene.camera.position, Vec3(0, 1, 6));
  EXPECT_EQ(scene.camera.target, Vec3(0, 0.5, 0));
  EXPECT_EQ(scene.camera.up, Vec3(0, 2, 0));
  EXPECT_EQ(scene.camera.field_of_view, 30);
  EXPECT_TRUE((scene.environment->radiance({1, 0, 0}) == Rgb(1, 0.5, 0.25)).all());
  ASSERT_EQ(scene.lights.size(), 1U);
  EXPECT_EQ(scene.lights[0].direction, Vec3(1, 2, 3));
  EXPECT_TRUE((scene.lights[0].irradiance == Rgb(3, 2, 1)).all());
  ASSERT_EQ(scene.objects.size(), 6U);
  EXPECT_EQ(scene.objects[0].name, "ball");
  EXPECT_EQ(scene.objects[0].material, given_[0]);
  EXPECT_EQ(std::get<Sphere>(scene.objects[0].shape).radius, 0.5);
  EXPECT_EQ(scene.objects[2].material, scene.objects[3].material);
  EXPECT_NEAR(scene.objects[1].material->eval({0.6, 0, 0.8}, {0, 0.6, 0.8})[0], 0.5 / 3.14159, 0.01);
  const Vec3 corner = std::get<MeshPtr>(scene.objects[2].shape)->vertices[0];
  EXPECT_LT((corner.cwiseAbs() - Vec3(3, 3, 1)).norm(), 1e-14) << "turned and scaled before it is moved";
  EXPECT_EQ(std::get<MeshPtr>(scene.objects[5].shape)->vertices[1], Vec3(2, 0, 0));
  EXPECT_TRUE((scene.objects[5].emission == Rgb(1, 2, 3)).all());
  EXPECT_EQ(scene.objects[5].material, nullptr);
}

TEST_F(SceneFile, EveryAnalyticModelIsAMaterial) {
  for (const AnalyticInfo& model : analytic::all()) {
    const Scene scene = read(
        R"({"format": "sklar scene", "version": 1, "environment": "studio", "materials": {"m": {"model": ")" +
        model.name + R"("}}, "objects": [{"shape": "sphere", "centre": [0, 0, 0], "radius": 1, "material": "m"}]})");
    const Vec3 wo(0.6, 0, 0.8), wi(0, 0.6, 0.8);
    EXPECT_TRUE((scene.objects[0].material->eval(wo, wi) == model.make(model.initial())->eval(wo, wi)).all())
        << model.name;
  }
  EXPECT_EQ(refused("\"f0\": [1, 0.8, 0.3]", "\"f0\": 2").find("scene.json: material 'gold': ggx: "), 0U);
}

TEST_F(SceneFile, DefaultsAndOtherEnvironments) {
  const std::string head = R"({"format": "sklar scene", "version": 1, "objects": [], "environment": )";
  const Scene constant = read(head + R"({"constant": [1, 2, 3]}})");
  EXPECT_TRUE((constant.environment->radiance({0, 1, 0}) == Rgb(1, 2, 3)).all());
  EXPECT_EQ(constant.width, 256);
  EXPECT_EQ(constant.depth, 8);
  const Scene studio = read(head + "\"studio\"}");
  EXPECT_LT((studio.environment->radiance({0, 0, -1}) - studio_environment({0, 0, -1})).abs().maxCoeff(), 0.02);
}

TEST_F(SceneFile, UnknownNamesShowTheNearest) {
  EXPECT_EQ(refused("\"exposure\"", "\"exposre\""),
            "scene.json: unknown key 'exposre'; the nearest known is 'exposure'");
  EXPECT_EQ(refused("\"field_of_view\"", "\"fov\""),
            "scene.json: camera: unknown key 'fov'; the nearest known is 'up'");
  EXPECT_EQ(refused("\"radius\"", "\"radus\""),
            "scene.json: object 1: unknown key 'radus'; the nearest known is 'radius'");
  EXPECT_EQ(refused("\"shape\": \"box\"", "\"shape\": \"bok\""),
            "scene.json: object 3: unknown shape 'bok'; the nearest known is 'box'");
  EXPECT_EQ(refused("\"material\": \"main\"", "\"material\": \"mian\""),
            "scene.json: object 1: unknown material 'mian'; the nearest known is 'main'");
  EXPECT_EQ(refused("\"alpha\": 0.2", "\"alhpa\": 0.2"),
            "scene.json: material 'gold': unknown key 'alhpa'; the nearest known is 'alpha'");
  EXPECT_EQ(
      refused("\"model\": \"ggx\"", "\"model\": \"gxx\"").find("scene.json: material 'gold': unknown reflectance"), 0U);
  EXPECT_EQ(refused("\"irradiance\"", "\"radiance\""),
            "scene.json: light 1: unknown key 'radiance'; the nearest known is 'irradiance'");
  EXPECT_EQ(refused("\"scale\": 2}", "\"sclae\": 2}"),
            "scene.json: environment: unknown key 'sclae'; the nearest known is 'scale'");
}

TEST_F(SceneFile, BadValuesAreNamed) {
  EXPECT_EQ(refused("[320, 200]", "[0, 200]"), "scene.json: size must be at least 1 x 1 pixels, got 0 x 200");
  EXPECT_EQ(refused("[320, 200]", "[320]"), "scene.json: field 'size' must be [width, height] in pixels, found [320]");
  EXPECT_EQ(refused("[320, 200]", "[1.5, 200]"),
            "scene.json: field 'size' must be [width, height] in pixels, found [1.5,200]");
  EXPECT_EQ(refused("\"radius\": 0.5", "\"radius\": -0.5"),
            "scene.json: object 1 (ball): radius must be positive and at most 1e15, got -0.5");
  EXPECT_EQ(refused(", \"radius\": 0.5", ""), "scene.json: object 1: field 'radius' is missing");
  EXPECT_EQ(refused("[0, 1, 0], \"radius\"", "[0, 1], \"radius\""),
            "scene.json: object 1: field 'centre' must have three numbers, has 2");
  EXPECT_EQ(refused("[3, 2, 1]", "[3, -2, 1]"),
            "scene.json: light 1: irradiance must be finite and not negative, got 3, -2, 1");
  EXPECT_EQ(refused("\"emission\": [1, 2, 3]", "\"emission\": -1"),
            "scene.json: object 6: emission must be finite and not negative, got -1, -1, -1");
  EXPECT_EQ(refused("\"scale\": 2, \"material\"", "\"scale\": 0, \"material\""),
            "scene.json: object 3: field 'scale' must be positive, found 0");
  EXPECT_EQ(refused("\"tube\": 0.25", "\"tube\": 2"),
            "scene.json: object 4: torus: tube must be positive and below ring");
  EXPECT_EQ(refused("[0.3, 0.5]", "[0.3]"),
            "scene.json: object 5: field 'profile' must hold pairs [radius, height], found [0.3]");
  EXPECT_EQ(refused("\"side_a\": [0, 0, 10]", "\"side_a\": [10, 0, 0]"),
            "scene.json: object 2: triangle 1 is degenerate: it has no area");
  EXPECT_EQ(refused("{\"given\": 1}", "{\"given\": 2}"),
            "scene.json: material 'main': is the given material 2, there are 1 from 1 on");
  EXPECT_EQ(refused("{\"given\": 1}", "{}"),
            "scene.json: material 'main': needs one of the keys given, file and model");
  EXPECT_EQ(refused("\"alpha\": 0.2", "\"alpha\": 2").find("scene.json: material 'gold': "), 0U);
  EXPECT_EQ(refused("0.25,\n", "1e999,\n"), "scene.json: holds a number that is beyond double");
  EXPECT_EQ(refused("\"depth\": 5,", "\"depth\": 5"), "scene.json: is not valid JSON: byte 86");
  EXPECT_EQ(refused("sklar scene", "sklar brdf").find("scene.json: expected \"format\": \"sklar scene\""), 0U);
}

TEST_F(SceneFile, FilesThatAreMissingOrBadAreNamed) {
  EXPECT_EQ(refused("triangle.obj", "none.obj"), "none.obj: no such file");
  EXPECT_EQ(refused("sky.exr", "none.exr").find("none.exr: "), 0U);
  EXPECT_EQ(refused("{\"given\": 1}", "{\"file\": \"none.bsdf\"}"), "none.bsdf: no such file");
  write_file(folder_ / "bad.obj", "v 0 0 0\nv 1 0 nan\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(refused("triangle.obj", "bad.obj"), "bad.obj: line 2: a coordinate is not finite");
  EXPECT_EQ(test::message_of<FileError>([&] { (void)read_scene(folder_ / "none.json", given_); }),
            (folder_ / "none.json").string() + ": no such file");
}

TEST_F(SceneFile, NoLightIsRefused) {
  const std::string dark = R"({"format": "sklar scene", "version": 1, "objects": []})";
  EXPECT_NE(test::message_of<FileError>([&] { (void)read(dark); }).find("scene.json: the scene has no light"),
            std::string::npos);
}

TEST(NearestName, CountsEdits) {
  const std::vector<std::string> known{"position", "target", "up"};
  EXPECT_EQ(nearest_name("postion", known), "position");
  EXPECT_EQ(nearest_name("targte", known), "target");
  EXPECT_EQ(nearest_name("u", known), "up");
  EXPECT_EQ(nearest_name("", known), "up");
}

}  // namespace
}  // namespace sklar::brdf
