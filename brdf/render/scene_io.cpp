#include "brdf/render/scene_io.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

#include "brdf/analytic/registry.hpp"
#include "brdf/analytic/sum.hpp"
#include "brdf/data/material.hpp"
#include "brdf/model/model_io.hpp"
#include "brdf/render/mesh_io.hpp"
#include "brdf/render/nearest_name.hpp"
#include "brdf/sampling/sampled_brdf.hpp"
#include "copula/file.hpp"
#include "copula/json_fields.hpp"

namespace sklar::brdf {
namespace {
using json::Json;
using Names = std::vector<std::string>;

/// What read does; its errors open with the name of the place.
template <class Read>
auto in(const std::string& place, const Read& read) {
  try {
    return read();
  } catch (const std::logic_error& error) {
    throw std::invalid_argument(place + ": " + error.what());
  }
}

[[noreturn]] void refuse_name(const std::string& what, const std::string& name, const Names& known) {
  throw std::invalid_argument("unknown " + what + " '" + name + "'" +
                              (known.empty() ? "" : "; the nearest known is '" + nearest_name(name, known) + "'"));
}

void require_keys(const Json& object, const Names& known) {
  if (!object.is_object()) throw std::invalid_argument("must be an object {..}, found " + object.dump());
  for (const auto& [key, value] : object.items()) {
    if (std::find(known.begin(), known.end(), key) == known.end()) refuse_name("key", key, known);
  }
}

double number(const Json& object, const char* name, double otherwise) {
  return object.contains(name) ? json::number(object, name) : otherwise;
}

Vec3 vector(const Json& object, const char* name) {
  const std::vector<double> values = json::numbers(object, name);
  if (values.size() != 3) {
    throw std::invalid_argument("field '" + std::string(name) + "' must have three numbers, has " +
                                std::to_string(values.size()));
  }
  return {values[0], values[1], values[2]};
}

Vec3 vector(const Json& object, const char* name, const Vec3& otherwise) {
  return object.contains(name) ? vector(object, name) : otherwise;
}

/// One number is a grey.
Rgb colour(const Json& object, const char* name) {
  return json::field(object, name).is_number() ? Rgb(Rgb::Constant(json::number(object, name)))
                                               : Rgb(vector(object, name).array());
}

Rgb colour(const Json& object, const char* name, const Rgb& otherwise) {
  return object.contains(name) ? colour(object, name) : otherwise;
}

class SceneReader {
 public:
  SceneReader(std::filesystem::path folder, std::span<const BrdfPtr> given)
      : folder_(std::move(folder)), given_(given) {}

  Scene read(const Json& document) {
    json::require_format(document, "sklar scene", kSceneVersion);
    require_keys(document, {"format", "version", "size", "depth", "exposure", "camera", "background", "environment",
                            "lights", "materials", "objects"});
    Scene scene;
    read_picture(document, scene);
    if (document.contains("environment")) {
      scene.environment = in("environment", [&] { return read_environment(document["environment"]); });
    }
    read_lights(document, scene);
    read_materials(document);
    const Json& objects = json::array(document, "objects");
    for (std::size_t i = 0; i < objects.size(); ++i) {
      scene.objects.push_back(in("object " + std::to_string(i + 1), [&] { return read_object(objects[i]); }));
    }
    require_scene(scene);
    return scene;
  }

 private:
  static void read_picture(const Json& document, Scene& scene) {
    if (document.contains("size")) {
      const std::vector<double> size = json::numbers(document, "size");
      const auto whole = [](double pixels) { return pixels >= 0 && pixels <= 1e6 && pixels == std::floor(pixels); };
      if (size.size() != 2 || !whole(size[0]) || !whole(size[1])) {
        throw std::invalid_argument("field 'size' must be [width, height] in pixels, found " + document["size"].dump());
      }
      scene.width = static_cast<int>(size[0]);
      scene.height = static_cast<int>(size[1]);
    }
    if (document.contains("depth")) scene.depth = json::integer(document, "depth");
    scene.exposure = number(document, "exposure", scene.exposure);
    if (document.contains("background")) scene.background = colour(document, "background");
    if (!document.contains("camera")) return;
    in("camera", [&] {
      const Json& camera = document["camera"];
      require_keys(camera, {"position", "target", "up", "field_of_view"});
      scene.camera = {.position = vector(camera, "position", scene.camera.position),
                      .target = vector(camera, "target", scene.camera.target),
                      .up = vector(camera, "up", scene.camera.up),
                      .field_of_view = number(camera, "field_of_view", scene.camera.field_of_view)};
    });
  }

  [[nodiscard]] EnvironmentPtr read_environment(const Json& value) const {
    if (value == "studio") {
      return std::make_shared<const EnvironmentMap>(EnvironmentMap::tabulated(studio_environment));
    }
    if (!value.is_object()) {
      throw std::invalid_argument("must be \"studio\", {\"constant\": radiance} or {\"file\": \"MAP.exr\"}, found " +
                                  value.dump());
    }
    if (value.contains("constant")) {
      require_keys(value, {"constant"});
      return std::make_shared<const EnvironmentMap>(EnvironmentMap::constant(colour(value, "constant")));
    }
    require_keys(value, {"file", "constant", "scale"});
    Image map = read_exr(folder_ / json::text(value, "file"));
    const auto scale = static_cast<float>(number(value, "scale", 1));
    for (float& channel : map.rgb) channel *= scale;
    return std::make_shared<const EnvironmentMap>(std::move(map));
  }

  static void read_lights(const Json& document, Scene& scene) {
    if (!document.contains("lights")) return;
    const Json& lights = json::array(document, "lights");
    for (std::size_t i = 0; i < lights.size(); ++i) {
      in("light " + std::to_string(i + 1), [&] {
        require_keys(lights[i], {"direction", "irradiance"});
        scene.lights.push_back({vector(lights[i], "direction"), colour(lights[i], "irradiance")});
      });
    }
  }

  void read_materials(const Json& document) {
    if (!document.contains("materials")) return;
    if (!document["materials"].is_object()) throw std::invalid_argument("field 'materials' must be an object {..}");
    for (const auto& [name, value] : document["materials"].items()) {
      const Json& description = value;
      materials_[name] = in("material '" + name + "'", [&] { return read_material_value(description); });
    }
  }

  [[nodiscard]] BrdfPtr read_material_value(const Json& value) const {
    if (value.is_object() && value.contains("given")) {
      require_keys(value, {"given"});
      const int index = json::integer(value, "given");
      if (index < 1 || static_cast<std::size_t>(index) > given_.size()) {
        throw std::invalid_argument("is the given material " + std::to_string(index) + ", there are " +
                                    std::to_string(given_.size()) + " from 1 on");
      }
      return given_[static_cast<std::size_t>(index - 1)];
    }
    if (value.is_object() && value.contains("file")) {
      require_keys(value, {"file"});
      const std::filesystem::path path = folder_ / json::text(value, "file");
      return std::make_shared<const SampledBrdf>(is_model_path(path.string()) ? read_brdf(path).brdf()
                                                                              : read_material_brdf(path));
    }
    if (!value.is_object() || !value.contains("model")) {
      require_keys(value, {"given", "file", "model"});
      throw std::invalid_argument("needs one of the keys given, file and model");
    }
    return read_analytic(value);
  }

  /// {"model": NAME, its parameters}, and "diffuse", the albedo of a Lambert below a model without such a parameter.
  static BrdfPtr read_analytic(const Json& value) {
    const AnalyticInfo& info = analytic::find(json::text(value, "model"));
    Names known{"model"};
    AnalyticValues values;
    Rgb strength = Rgb::Ones();
    for (const AnalyticParameter& parameter : info.parameters) {
      const char* name = parameter.name.c_str();
      known.push_back(parameter.name);
      if (parameter.per_channel) {
        strength = colour(value, name, Rgb::Constant(parameter.initial));
        values.insert(values.end(), strength.begin(), strength.end());
      } else {
        values.push_back(number(value, name, parameter.initial));
      }
    }
    const bool on_diffuse = std::find(known.begin(), known.end(), "diffuse") == known.end();
    if (on_diffuse) known.emplace_back("diffuse");
    require_keys(value, known);
    BrdfPtr lobe = info.make(values);
    return on_diffuse && value.contains("diffuse") ? with_diffuse(colour(value, "diffuse"), lobe, strength) : lobe;
  }

  [[nodiscard]] Object read_object(const Json& value) const {
    static const std::map<std::string, Names> kShapes{{"sphere", {"centre", "radius"}},
                                                      {"rectangle", {"corner", "side_a", "side_b"}},
                                                      {"box", {"size", "at", "turn", "scale"}},
                                                      {"torus", {"ring", "tube", "at", "turn", "scale"}},
                                                      {"revolution", {"profile", "at", "turn", "scale"}},
                                                      {"mesh", {"file", "at", "turn", "scale"}}};
    const std::string shape = json::text(value, "shape");
    const auto found = kShapes.find(shape);
    if (found == kShapes.end()) {
      Names names;
      for (const auto& [name, keys] : kShapes) names.push_back(name);
      refuse_name("shape", shape, names);
    }
    Names known{"name", "shape", "material", "emission"};
    known.insert(known.end(), found->second.begin(), found->second.end());
    require_keys(value, known);
    Object object;
    if (value.contains("name")) object.name = json::text(value, "name");
    if (value.contains("material")) object.material = material_named(json::text(value, "material"));
    object.emission = colour(value, "emission", Rgb::Zero());
    if (shape == "sphere") {
      object.shape = Sphere{vector(value, "centre"), json::number(value, "radius")};
    } else {
      object.shape = std::make_shared<const TriangleMesh>(placed(read_shape(shape, value), read_placement(value)));
    }
    return object;
  }

  [[nodiscard]] BrdfPtr material_named(const std::string& name) const {
    if (const auto found = materials_.find(name); found != materials_.end()) return found->second;
    Names known;
    for (const auto& [key, material] : materials_) known.push_back(key);
    refuse_name("material", name, known);
  }

  static Placement read_placement(const Json& value) {
    const Placement placement{.scale = number(value, "scale", 1),
                              .turn = number(value, "turn", 0) * std::numbers::pi / 180,
                              .at = vector(value, "at", Vec3::Zero())};
    if (!(placement.scale > 0)) {
      throw std::invalid_argument("field 'scale' must be positive, found " + sklar::to_text(placement.scale));
    }
    return placement;
  }

  [[nodiscard]] TriangleMesh read_shape(const std::string& shape, const Json& value) const {
    if (shape == "rectangle")
      return rectangle(vector(value, "corner"), vector(value, "side_a"), vector(value, "side_b"));
    if (shape == "box") return box(vector(value, "size"));
    if (shape == "torus") return torus(json::number(value, "ring"), json::number(value, "tube"));
    if (shape == "mesh") return read_mesh(folder_ / json::text(value, "file"));
    std::vector<Vec2> profile;
    for (const Json& point : json::array(value, "profile")) {
      if (!point.is_array() || point.size() != 2 || !point[0].is_number() || !point[1].is_number()) {
        throw std::invalid_argument("field 'profile' must hold pairs [radius, height], found " + point.dump());
      }
      profile.emplace_back(point[0].get<double>(), point[1].get<double>());
    }
    return revolution(profile);
  }

  std::filesystem::path folder_;
  std::span<const BrdfPtr> given_;
  std::map<std::string, BrdfPtr> materials_;
};

}  // namespace

Scene parse_scene(std::string_view text, std::string_view source, const std::filesystem::path& folder,
                  std::span<const BrdfPtr> given) {
  return json::parse(text, source, [&](const Json& document) { return SceneReader(folder, given).read(document); });
}

Scene read_scene(const std::filesystem::path& path, std::span<const BrdfPtr> given) {
  return parse_scene(read_file(path), path.string(), path.parent_path(), given);
}

}  // namespace sklar::brdf
