#include <array>

#include "copula/error.hpp"
#include "copula/inference/csv.hpp"
#include "copula/inference/model_io.hpp"
#include "copula/symbolic/family_definition.hpp"
#include "copula/symbolic/parser.hpp"
#include "copula/symbolic/print.hpp"
#include "families/registry.hpp"
#include "tests/fuzz/targets.hpp"

namespace sklar::test {
namespace {

bool csv(std::string_view bytes) {
  return returned<FileError>([&] { (void)parse_csv(bytes, "input"); });
}

bool copula_model(std::string_view bytes) {
  CopulaModel model;
  if (!returned<FileError>([&] { model = parse_model(bytes, "input", families::all()); })) return false;
  const std::string written = to_json(model);
  require_same(written, to_json(parse_model(written, "written", families::all())));
  constexpr int kSmall = 100;  // a copula takes memory in proportion to its dimension
  if (model.dim > kSmall) return true;
  return returned<std::domain_error>([&] { (void)make_copula(model, families::all()); });
}

bool family(std::string_view bytes) {
  symbolic::FamilyDefinition definition;
  if (!returned<FileError>([&] { definition = symbolic::parse_definition(bytes, "input"); })) return false;
  const std::string written = to_json(definition);
  require_same(written, to_json(symbolic::parse_definition(written, "written")));
  return true;
}

bool formula(std::string_view bytes) {
  return returned<symbolic::ParseError>([&] { (void)symbolic::to_text(symbolic::parse(bytes)); });
}

constexpr std::array<FuzzTarget, 4> kTargets{
    {{"csv", csv, 20000}, {"copula_model", copula_model, 1000}, {"family", family, 5000}, {"formula", formula, 1000}}};

}  // namespace

std::span<const FuzzTarget> copula_targets() {
  return kTargets;
}

}  // namespace sklar::test
