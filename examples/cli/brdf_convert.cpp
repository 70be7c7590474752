#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "brdf/data/merl.hpp"
#include "brdf/data/tabulate.hpp"
#include "brdf/model/model_io.hpp"
#include "copula/error.hpp"
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

void run(const std::string& in, const std::string& out, bool json) {
  if (brdf::is_model_path(in) && brdf::is_model_path(out)) {
    brdf::write_brdf(out, brdf::read_brdf(in));
  } else if (std::filesystem::path(out).extension() == ".binary") {
    brdf::write_merl(out, *table_of(in));
  } else {
    throw FileError(out, "a table is written as .binary, a model as .json or .sklar");
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
  command->add_option("OUT", *out, "MERL .binary, or of a model .json or .sklar")->required();
  finish_command(*command, common, [=, &common] { run(*in, *out, common.json); });
}

}  // namespace sklar::cli
