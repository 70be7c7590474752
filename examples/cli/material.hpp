#pragma once
/// What the `brdf` subcommands work on.

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "brdf/data/material.hpp"
#include "brdf/data/table_brdf.hpp"
#include "brdf/progress.hpp"

namespace sklar::cli {

inline constexpr const char* kMaterialHelp =
    "MERL .binary, RGL .bsdf, pbrt-v2 .brdf, .csv of wi, wo, rgb, or one of the built-in materials synthetic (the "
    "default) and synthetic-anisotropic";

/// The built-in isotropic material.
inline constexpr const char* kSynthetic = "synthetic";

/// Adds the positional MATERIAL; omitted, it is the built-in one.
void add_material(CLI::App& command, std::string& path);

/// An isotropic material: a file, or the built-in one where path is empty or its name.
/// @param provenance of a file whose format does not say. @throws FileError; also for an anisotropic material.
[[nodiscard]] std::shared_ptr<const brdf::MeasuredTable> load_table(
    const std::string& path, brdf::Provenance provenance = brdf::Provenance::unknown);

/// ContenderData::inputs: the version of this program, the provenance, and the 64-bit FNV-1a hash of the file or the
/// name of the built-in material. @throws FileError
[[nodiscard]] std::string inputs_of(const std::string& path, brdf::Provenance provenance);

/// A material on three coordinates where it is isotropic, on four where not. @throws FileError.
[[nodiscard]] brdf::Material load_any_table(const std::string& path, brdf::Provenance provenance);

/// A fitted model (.json, .sklar), or any material, read between its cell centres or as its file says.
[[nodiscard]] brdf::BrdfPtr load_brdf(const std::string& path);

/// The same with a sampler made for it: what `brdf sample` draws by and `brdf eval` says the pdf of.
[[nodiscard]] brdf::BrdfPtr load_sampled_brdf(const std::string& path);

/// As load_brdf, for what takes isotropic reflectance alone. @throws FileError for an anisotropic one.
[[nodiscard]] brdf::BrdfPtr load_isotropic_brdf(const std::string& path);

/// A bar on stderr where that is a terminal, else nothing.
[[nodiscard]] brdf::Progress progress_bar(std::string label);

/// One line on stderr that says what is being done, where that is a terminal; removed at the end.
class StepLine {
 public:
  StepLine();
  ~StepLine();
  StepLine(const StepLine&) = delete;
  StepLine& operator=(const StepLine&) = delete;

  void show(const std::string& what) const;

 private:
  bool visible_;
};

}  // namespace sklar::cli
