#include <algorithm>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "brdf/code/cpp_header.hpp"
#include "brdf/code/glsl.hpp"
#include "brdf/data/merl.hpp"
#include "brdf/data/rgl_writer.hpp"
#include "brdf/data/tabulate.hpp"
#include "brdf/model/model_io.hpp"
#include "brdf/study/energy.hpp"
#include "copula/error.hpp"
#include "copula/file.hpp"
#include "copula/listed.hpp"
#include "examples/cli/command.hpp"
#include "examples/cli/material.hpp"
#include "examples/cli/text.hpp"

namespace sklar::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
  std::string in, out, form = "rgb";
  double max_albedo = 1;
};

// A material, or a fitted model at the cell centres.
std::shared_ptr<const brdf::MeasuredTable> table_of(const std::string& path) {
  if (!brdf::is_model_path(path)) return load_table(path);
  const brdf::StoredBrdf model = brdf::read_brdf(path);
  return std::make_shared<const brdf::MeasuredTable>(brdf::tabulate(*model.brdf(), model.material, model.provenance));
}

Json write_model(const Options& options) {
  if (!brdf::is_model_path(options.in)) throw FileError(options.in, "is no model; `sklar brdf fit` makes one of it");
  brdf::write_brdf(options.out, brdf::read_brdf(options.in));
  return Json::object();
}

Json write_binary(const Options& options) {
  brdf::write_merl(options.out, *table_of(options.in));
  return Json::object();
}

template <class Model>
Json json_of(const brdf::Limited<Model>& limited) {
  return {{"albedo_before", limited.albedo_before},
          {"albedo", limited.albedo_after},
          {"lowest_factor", limited.lowest_factor}};
}

Json write_bsdf(const Options& options) {
  const auto limited = brdf::limit_albedo(load_brdf(options.in), options.max_albedo);
  const auto form = options.form == "spectra" ? brdf::RglForm::spectra : brdf::RglForm::rgb;
  brdf::write_rgl(options.out, *limited.brdf,
                  {.form = form, .description = std::filesystem::path(options.in).stem().string() + " (sklar)"});
  return json_of(limited);
}

/// A source of code: evaluation_code of a model, and its sampler where it is asked for.
using Source = std::string (*)(const brdf::ModelCode& code, const brdf::BrdfPtr& model, const std::string& material);

Json write_source(const Options& options, Source source) {
  if (!brdf::is_model_path(options.in)) throw FileError(options.in, "written as source are models, .json or .sklar");
  const brdf::StoredBrdf stored = brdf::read_brdf(options.in);
  return std::visit(
      [&](const auto& model) -> Json {
        if constexpr (requires { brdf::evaluation_code(*model); }) {
          const auto limited = brdf::limit_albedo(model, options.max_albedo);
          write_file(options.out, source(brdf::evaluation_code(*limited.brdf), limited.brdf, stored.material));
          return json_of(limited);
        } else {
          throw FileError(options.in, "written as source are refined models");
        }
      },
      stored.model);
}

Json write_glsl(const Options& options) {
  return write_source(options,
                      [](const brdf::ModelCode& code, const brdf::BrdfPtr& model, const std::string& material) {
                        return to_glsl(with_sampler(code, brdf::ConditionalSampler(*model)), material);
                      });
}

Json write_cpp(const Options& options) {
  return write_source(options,
                      [](const brdf::ModelCode& code, const brdf::BrdfPtr& model, const std::string& material) {
                        return to_cpp_header(with_sampler(code, brdf::ConditionalSampler(*model)), material);
                      });
}

Json write_explorer(const Options& options) {
  return write_source(options, [](const brdf::ModelCode& code, const brdf::BrdfPtr&, const std::string& material) {
    return to_brdf_explorer(code, material);
  });
}

struct Format {
  std::string extension;
  std::vector<std::string> options;           ///< of those below, the ones that it takes
  std::function<Json(const Options&)> write;  ///< @return what --json says of it, besides the file's name
};

const std::vector<Format> kFormats = {{".json", {}, write_model},
                                      {".sklar", {}, write_model},
                                      {".binary", {}, write_binary},
                                      {".bsdf", {"--form", "--max-albedo"}, write_bsdf},
                                      {".glsl", {"--max-albedo"}, write_glsl},
                                      {".hpp", {"--max-albedo"}, write_cpp},
                                      {".brdf", {"--max-albedo"}, write_explorer}};

const Format& format_of(const std::string& out) {
  const std::string extension = std::filesystem::path(out).extension().string();
  for (const Format& format : kFormats) {
    if (format.extension == extension) return format;
  }
  throw FileError(out, "has extension '" + extension + "', expected one of " + listed(kFormats, &Format::extension));
}

void run(const CLI::App& command, const Options& options, bool json) {
  const Format& format = format_of(options.out);
  for (const std::string option : {"--form", "--max-albedo"}) {
    const bool takes = std::find(format.options.begin(), format.options.end(), option) != format.options.end();
    if (!takes && command.count(option) > 0) {
      throw std::invalid_argument(option + " does not go with " + format.extension);
    }
  }
  const Json said = format.write(options);
  if (json) {
    Json document = {{"output", options.out}};
    document.update(said);
    print_json(document);
  } else if (said.value("lowest_factor", 1.0) < 1) {
    const auto figure = [&](const char* name) { return digits(said[name].get<double>()); };
    std::cout << "largest directional albedo " << figure("albedo_before") << ", limited " << figure("albedo")
              << "; values multiplied by " << figure("lowest_factor") << " to 1\n";
  }
}

}  // namespace

void add_brdf_convert(CLI::App& parent, Common& common) {
  CLI::App* command = parent.add_subcommand("convert", "write a material in another format, by extension");
  const auto options = std::make_shared<Options>();
  command->add_option("IN", options->in, std::string(kMaterialHelp) + ", or fitted model .json or .sklar")->required();
  command
      ->add_option(
          "OUT", options->out,
          "MERL .binary (isotropic), RGL .bsdf for Mitsuba 3 and pbrt-v4; of a model .json or .sklar, or as source "
          ".glsl, .hpp (C++17) or .brdf (BRDF Explorer)")
      ->required();
  command
      ->add_option("--form", options->form,
                   ".bsdf: rgb (Mitsuba 3, RGB variants) or spectra (pbrt-v4; Mitsuba 3, spectral variants)")
      ->check(CLI::IsMember({"rgb", "spectra"}))
      ->capture_default_str();
  command
      ->add_option(
          "--max-albedo", options->max_albedo,
          ".bsdf and source: lower the reflectance where its directional albedo is larger; inf leaves it as it is")
      ->capture_default_str();
  finish_command(*command, common, [command, options, &common] { run(*command, *options, common.json); });
}

}  // namespace sklar::cli
