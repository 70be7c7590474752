#include <array>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "brdf/code/cpp_header.hpp"
#include "brdf/code/glsl.hpp"
#include "brdf/data/merl.hpp"
#include "brdf/data/tabulate.hpp"
#include "brdf/model/model_io.hpp"
#include "brdf/study/energy.hpp"
#include "copula/error.hpp"
#include "copula/file.hpp"
#include "examples/cli/command.hpp"
#include "examples/cli/material.hpp"
#include "examples/cli/text.hpp"

namespace sklar::cli {
namespace {

// A material, or a fitted model at the cell centres.
std::shared_ptr<const brdf::MeasuredTable> table_of(const std::string& path) {
  if (!brdf::is_model_path(path)) return load_table(path);
  const brdf::StoredBrdf model = brdf::read_brdf(path);
  return std::make_shared<const brdf::MeasuredTable>(brdf::tabulate(*model.brdf(), model.material, model.provenance));
}

// A model as source, by extension.
struct SourceWriter {
  const char* extension;
  std::string (*text)(const brdf::RefinedBrdf& model, const std::string& material);
};

constexpr std::array<SourceWriter, 3> kSources = {{
    {".glsl",
     [](const brdf::RefinedBrdf& model, const std::string& material) {
       return to_glsl(sampling_code(model, brdf::ConditionalSampler(model)), material);
     }},
    {".hpp",
     [](const brdf::RefinedBrdf& model, const std::string& material) {
       return to_cpp_header(sampling_code(model, brdf::ConditionalSampler(model)), material);
     }},
    {".brdf", [](const brdf::RefinedBrdf& model,
                 const std::string& material) { return to_brdf_explorer(evaluation_code(model), material); }},
}};

const SourceWriter* source_writer(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  for (const SourceWriter& writer : kSources) {
    if (extension == writer.extension) return &writer;
  }
  return nullptr;
}

// The model with an albedo of at most 1.
void write_source(const std::string& in, const std::string& out, const SourceWriter& writer) {
  if (!brdf::is_model_path(in)) throw FileError(in, "written as source are models, .json or .sklar");
  const brdf::StoredBrdf stored = brdf::read_brdf(in);
  const auto* model = std::get_if<std::shared_ptr<const brdf::RefinedBrdf>>(&stored.model);
  if (model == nullptr) throw FileError(in, "written as source are refined models of isotropic materials");
  const brdf::Limited<brdf::RefinedBrdf> limited = brdf::limit_albedo(*model);
  if (limited.lowest_factor < 1) {
    std::cerr << "note: " << in << " has a directional albedo of " << digits(limited.albedo_before) << "; " << out
              << " has " << digits(limited.albedo_after) << ", its values multiplied by "
              << digits(limited.lowest_factor) << " to 1\n";
  }
  write_file(out, writer.text(*limited.brdf, stored.material));
}

void run(const std::string& in, const std::string& out, bool json) {
  if (brdf::is_model_path(in) && brdf::is_model_path(out)) {
    brdf::write_brdf(out, brdf::read_brdf(in));
  } else if (std::filesystem::path(out).extension() == ".binary") {
    brdf::write_merl(out, *table_of(in));
  } else if (const SourceWriter* writer = source_writer(out); writer != nullptr) {
    write_source(in, out, *writer);
  } else {
    throw FileError(out, "a table is written as .binary, a model as .json or .sklar, or as source: .glsl, .hpp, .brdf");
  }
  if (json) print_json({{"output", out}});
}

}  // namespace

void add_brdf_convert(CLI::App& parent, Common& common) {
  CLI::App* command = parent.add_subcommand("convert", "write a material in another format, by extension");
  const auto in = std::make_shared<std::string>();
  const auto out = std::make_shared<std::string>();
  command->add_option("IN", *in, "MERL .binary, RGL .bsdf of an isotropic material, or fitted model .json or .sklar")
      ->required();
  command
      ->add_option(
          "OUT", *out,
          "MERL .binary, or of a model .json or .sklar, or its source: .glsl, .hpp (C++17), .brdf (BRDF Explorer); "
          "as source its albedo is at most 1")
      ->required();
  finish_command(*command, common, [=, &common] { run(*in, *out, common.json); });
}

}  // namespace sklar::cli
