#include "brdf/data/material.hpp"

#include "brdf/data/merl.hpp"
#include "brdf/data/rgl.hpp"
#include "copula/error.hpp"

namespace sklar::brdf {
namespace {

std::string material_name(const std::filesystem::path& path) {
  constexpr std::string_view kSuffix = "_rgb";
  std::string name = path.stem().string();
  if (name.size() > kSuffix.size() && name.ends_with(kSuffix)) name.resize(name.size() - kSuffix.size());
  return name;
}

}  // namespace

MeasuredTable load_material(const std::filesystem::path& path, Provenance binary_provenance) {
  const std::string extension = path.extension().string();
  if (extension == ".bsdf") return resample(RglMaterial(path), material_name(path));
  if (extension != ".binary") {
    throw FileError(path.string(), "has extension '" + extension + "', expected .binary (MERL) or .bsdf (RGL)");
  }
  MeasuredTable table = read_merl(path, binary_provenance);
  table.name = material_name(path);
  return table;
}

}  // namespace sklar::brdf
