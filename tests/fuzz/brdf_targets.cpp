#include <array>
#include <memory>

#include "brdf/analytic/registry.hpp"
#include "brdf/data/merl.hpp"
#include "brdf/data/rgl.hpp"
#include "brdf/data/scattered.hpp"
#include "brdf/model/model_binary.hpp"
#include "brdf/render/environment_map.hpp"
#include "brdf/render/image.hpp"
#include "brdf/render/mesh_io.hpp"
#include "brdf/render/scene_io.hpp"
#include "brdf/study/model_row.hpp"
#include "copula/error.hpp"
#include "tests/fuzz/memory_file.hpp"
#include "tests/fuzz/targets.hpp"

namespace sklar::test {
namespace {

using namespace brdf;

/// At a few pairs of directions, the normal and one near the horizon among them.
void evaluate(const Brdf& brdf) {
  const std::array<Vec3, 4> directions{{{0, 0, 1}, {0.6, 0, 0.8}, {-0.48, 0.64, 0.6}, Vec3(0, -1, 1e-6).normalized()}};
  for (const Vec3& wo : directions) {
    for (const Vec3& wi : directions) (void)brdf.eval(wo, wi);
  }
}

/// Of six cells: the files of a whole grid differ in their number alone.
bool merl(std::string_view bytes) {
  const MemoryFile file(bytes);
  return returned<FileError>([&] { (void)read_merl_cells(file.path(), {1, 2, 3}); });
}

bool bsdf(std::string_view bytes) {
  const MemoryFile file(bytes);
  std::shared_ptr<const RglMaterial> material;
  if (!returned<FileError>([&] { material = std::make_shared<const RglMaterial>(file.path()); })) return false;
  evaluate(RglBrdf(material));
  return true;
}

bool pbrt_brdf(std::string_view bytes) {
  const MemoryFile file(bytes);
  return returned<FileError>([&] { (void)read_pbrt_brdf(file.path()); });
}

bool scattered_csv(std::string_view bytes) {
  const MemoryFile file(bytes);
  return returned<FileError>([&] { (void)read_scattered_csv(file.path()); });
}

void require_round_trip(const StoredBrdf& model) {
  evaluate(*model.brdf());
  const std::string written = to_json(model);
  require_same(written, to_json(parse_brdf(written, "written")));
  if (std::holds_alternative<std::shared_ptr<const PaperBrdf>>(model.model)) return;
  const std::string binary = to_binary(model);
  require_same(binary, to_binary(parse_binary(binary, "written")));
}

bool brdf_model(std::string_view bytes) {
  StoredBrdf model;
  if (!returned<FileError>([&] { model = parse_brdf(bytes, "input"); })) return false;
  require_round_trip(model);
  return true;
}

bool brdf_binary(std::string_view bytes) {
  StoredBrdf model;
  if (!returned<FileError>([&] { model = parse_binary(bytes, "input"); })) return false;
  require_round_trip(model);
  return true;
}

/// Its files are missing, whatever they are called.
bool scene(std::string_view bytes) {
  const std::vector<BrdfPtr> given{analytic::find("lambert").make({0.5, 0.5, 0.5})};
  return returned<FileError>([&] { (void)parse_scene(bytes, "input", "/proc/self/fd/missing", given); });
}

bool obj(std::string_view bytes) {
  return returned<std::invalid_argument>([&] { require_mesh(parse_obj(bytes)); });
}

bool ply(std::string_view bytes) {
  return returned<std::invalid_argument>([&] { require_mesh(parse_ply(bytes)); });
}

bool exr(std::string_view bytes) {
  const MemoryFile file(bytes);
  Image image;
  if (!returned<FileError>([&] { image = read_exr(file.path()); })) return false;
  return returned<std::invalid_argument>([&] { (void)EnvironmentMap(std::move(image)); });
}

bool png(std::string_view bytes) {
  const MemoryFile file(bytes);
  return returned<FileError>([&] { (void)read_png(file.path()); });
}

bool model_row(std::string_view bytes) {
  ModelRow row;
  if (!returned<FileError>([&] { row = model_row_from_json(bytes, "input"); })) return false;
  const std::string written = to_json(row);
  require_same(written, to_json(model_row_from_json(written, "written")));
  return true;
}

constexpr std::array<FuzzTarget, 12> kTargets{{{"merl", merl, 5000},
                                               {"bsdf", bsdf, 5000},
                                               {"pbrt_brdf", pbrt_brdf, 5000},
                                               {"scattered_csv", scattered_csv, 5000},
                                               {"brdf_model", brdf_model, 1000},
                                               {"brdf_binary", brdf_binary, 1000},
                                               {"scene", scene, 2000},
                                               {"obj", obj, 10000},
                                               {"ply", ply, 10000},
                                               {"exr", exr, 2000},
                                               {"png", png, 2000},
                                               {"model_row", model_row, 2000}}};

}  // namespace

std::span<const FuzzTarget> brdf_targets() {
  return kTargets;
}

}  // namespace sklar::test
