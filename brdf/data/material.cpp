#include "brdf/data/material.hpp"

#include <array>
#include <cstdio>

#include "brdf/data/isotropy.hpp"
#include "brdf/data/merl.hpp"
#include "brdf/data/rgl.hpp"
#include "brdf/data/scattered.hpp"
#include "brdf/data/table_brdf.hpp"
#include "copula/json_fields.hpp"

namespace sklar::brdf {
namespace {

FileError unknown_extension(const std::filesystem::path& path) {
  return {path.string(), "has extension '" + path.extension().string() +
                             "', expected .binary (MERL), .bsdf (RGL), .brdf (pbrt-v2) or .csv (wi, wo, rgb)"};
}

/// An RGL file, and whether its material is.
struct RglFile {
  std::shared_ptr<const RglMaterial> material;
  double isotropy_deviation;

  explicit RglFile(const std::filesystem::path& path)
      : material(std::make_shared<const RglMaterial>(path)),
        isotropy_deviation(material->isotropic() ? 0.0 : brdf::isotropy_deviation(RglBrdf(material))) {}

  [[nodiscard]] bool isotropic() const { return isotropy_deviation <= kSymmetricDeviation; }

  /// Precondition: isotropic().
  [[nodiscard]] MeasuredTable table(const std::string& name) const {
    if (material->isotropic()) return resample(*material, name);
    MeasuredTable mean = isotropic_mean(RglBrdf(material), name, Provenance::measured);
    mean.report.negative_share = material->negative_share();
    mean.report.median_asymmetry = median_asymmetry(*material);
    mean.report.isotropy_deviation = isotropy_deviation;
    return mean;
  }
};

bool is_rgl(const std::filesystem::path& path) {
  return path.extension() == ".bsdf";
}

/// A file of any other format, which does not say where its data come from.
MeasuredTable read_table(const std::filesystem::path& path, Provenance provenance) {
  const std::string extension = path.extension().string();
  if (extension == ".csv") return tabulate_scattered(read_scattered_csv(path), material_name(path), provenance);
  if (extension == ".brdf") return tabulate_scattered(read_pbrt_brdf(path), material_name(path), provenance);
  if (extension != ".binary") throw unknown_extension(path);
  MeasuredTable table = read_merl(path, provenance);
  table.name = material_name(path);
  return table;
}

}  // namespace

std::string material_name(const std::filesystem::path& path) {
  std::string name = path.stem().string();
  try {
    json::require_utf8("the name of the file", name);
  } catch (const std::invalid_argument& error) {
    throw FileError(path.string(), error.what());
  }
  for (const std::string_view suffix : {"_rgb", "_spec"}) {
    if (name.size() > suffix.size() && name.ends_with(suffix)) {
      name.resize(name.size() - suffix.size());
      break;
    }
  }
  return name;
}

void require_material_file(const std::filesystem::path& path) {
  for (const char* known : {".binary", ".bsdf", ".brdf", ".csv"}) {
    if (path.extension() != known) continue;
    if (!std::filesystem::exists(path)) throw FileError(path.string(), "no such file");
    return;
  }
  throw unknown_extension(path);
}

Material read_material(const std::filesystem::path& path, Provenance provenance) {
  if (!is_rgl(path)) return read_table(path, provenance);
  const RglFile file(path);
  if (file.isotropic()) return file.table(material_name(path));
  return resample_anisotropic(file.material, material_name(path));
}

MeasuredTable load_material(const std::filesystem::path& path, Provenance provenance) {
  if (!is_rgl(path)) return read_table(path, provenance);
  const RglFile file(path);
  if (file.isotropic()) return file.table(material_name(path));
  throw anisotropic_error(path.string(), file.isotropy_deviation);
}

BrdfPtr read_material_brdf(const std::filesystem::path& path) {
  if (is_rgl(path)) {
    const RglFile file(path);
    if (!file.isotropic()) return std::make_shared<const RglBrdf>(file.material);
    return std::make_shared<const TableBrdf>(std::make_shared<const MeasuredTable>(file.table(material_name(path))));
  }
  return std::make_shared<const TableBrdf>(
      std::make_shared<const MeasuredTable>(read_table(path, Provenance::unknown)));
}

FileError anisotropic_error(std::string_view path, double isotropy_deviation) {
  std::array<char, 16> digits{};
  std::snprintf(digits.data(), digits.size(), "%.2f", isotropy_deviation);
  return {path,
          "is anisotropic (isotropy deviation " + std::string(digits.data()) + "); this needs an isotropic material"};
}

}  // namespace sklar::brdf
