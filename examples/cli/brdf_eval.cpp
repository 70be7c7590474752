#include <cmath>
#include <memory>

#include "copula/error.hpp"
#include "copula/inference/csv.hpp"
#include "examples/cli/command.hpp"
#include "examples/cli/fitted_part.hpp"
#include "examples/cli/material.hpp"
#include "examples/cli/text.hpp"

namespace sklar::cli {
namespace {

const std::vector<std::string> kHeader{"wi_x", "wi_y", "wi_z", "wo_x", "wo_y", "wo_z"};
constexpr double kLengthTolerance = 1e-6;

struct Pairs {
  brdf::Directions wi, wo;
};

/// @throws FileError naming the line of a vector that is not of unit length.
Pairs read_pairs(const std::string& path) {
  const Table table = read_csv(path);
  if (table.names != kHeader) throw FileError(path, "line 1: the header must be wi_x,wi_y,wi_z,wo_x,wo_y,wo_z");
  Pairs pairs{table.values.leftCols<3>(), table.values.rightCols<3>()};
  for (brdf::Directions* directions : {&pairs.wi, &pairs.wo}) {
    for (Index row = 0; row < directions->rows(); ++row) {
      const double length = directions->row(row).matrix().norm();
      if (!(std::abs(length - 1) <= kLengthTolerance)) {
        throw FileError(path, "line " + std::to_string(row + 2) + ": " + (directions == &pairs.wi ? "wi" : "wo") +
                                  " must have length 1, got " + to_text(length));
      }
      directions->row(row) /= length;
    }
  }
  return pairs;
}

void run(const std::string& path, const std::string& directions, const std::string& output, bool json) {
  const Pairs pairs = read_pairs(directions);
  const brdf::BrdfPtr material = load_sampled_brdf(path);
  Points rows(pairs.wi.rows(), 4);
  rows.leftCols<3>() = material->eval(pairs.wo, pairs.wi);
  for (Index row = 0; row < rows.rows(); ++row) {
    rows(row, 3) = material->pdf(pairs.wo.row(row).transpose(), pairs.wi.row(row).transpose());
  }
  warn_of_pairs(path, *material, pairs.wo, pairs.wi);
  write_table(output, {"r", "g", "b", "pdf"}, rows, json);
}

}  // namespace

void add_brdf_eval(CLI::App& parent, Common& common) {
  CLI::App* command =
      parent.add_subcommand("eval", "f_r [1/sr] without the cosine, and the sampler's pdf of wi given wo");
  const auto material = std::make_shared<std::string>();
  const auto directions = std::make_shared<std::string>();
  const auto output = std::make_shared<std::string>();
  add_material(*command, *material);
  command->add_option("--directions", *directions, "CSV with the header wi_x,wi_y,wi_z,wo_x,wo_y,wo_z")->required();
  command->add_option("-o", *output, "write here, not to standard output");
  finish_command(*command, common, [=, &common] { run(*material, *directions, *output, common.json); });
}

}  // namespace sklar::cli
