#include <algorithm>
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
  Table table;
  if (!returned<FileError>([&] { table = parse_csv(bytes, "input"); })) return false;
  const std::string written = to_csv(table.names, table.values);
  const Table again = parse_csv(written, "written");
  require_same(written, to_csv(again.names, again.values));
  return true;
}

/// As `sklar copula fit` reads: the first line has the columns, and a ! in front to leave out incomplete rows.
bool csv_sample(std::string_view bytes) {
  const std::size_t end = std::min(bytes.find('\n'), bytes.size());
  std::string_view first = bytes.substr(0, end);
  CsvOptions options{.missing = Missing::refuse};
  if (first.starts_with('!')) {
    options.missing = Missing::drop;
    first.remove_prefix(1);
  }
  for (std::size_t comma = 0; !first.empty(); first.remove_prefix(std::min(comma + 1, first.size()))) {
    comma = std::min(first.find(','), first.size());
    options.columns.emplace_back(first.substr(0, comma));
  }
  return returned<FileError>([&] {
    const Table table = parse_csv(bytes.substr(std::min(end + 1, bytes.size())), "input", options);
    if (table.lines.size() != static_cast<std::size_t>(table.values.rows())) throw std::runtime_error("rows and lines");
  });
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

constexpr std::array<FuzzTarget, 5> kTargets{{{"csv", csv, 20000},
                                              {"csv_sample", csv_sample, 20000},
                                              {"copula_model", copula_model, 1000},
                                              {"family", family, 5000},
                                              {"formula", formula, 1000}}};

}  // namespace

std::span<const FuzzTarget> copula_targets() {
  return kTargets;
}

}  // namespace sklar::test
