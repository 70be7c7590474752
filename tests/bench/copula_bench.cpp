/// Nanoseconds a row over the list of families, each quantity by the closed forms and from the formula of psi alone;
/// baselines in the same run. Names: log_pdf/frank/d=2/n=4096, formula/log_pdf/frank/d=2/n=1024. Run by tests/bench.sh.

#include <benchmark/benchmark.h>

#include <cmath>

#include "copula/symbolic/derivative.hpp"
#include "copula/symbolic/formula_family.hpp"
#include "copula/symbolic/parser.hpp"
#include "copula/symbolic/tape.hpp"
#include "families/registry.hpp"

namespace {

using namespace sklar;

constexpr double kTau = 0.5;
constexpr Index kRows = 4096;
constexpr Index kFormulaRows = 1024;

/// The parameter with tau = 1/2, or with the largest tau below it that the examples have.
Theta parameter(const FamilyInfo& family, int dim) {
  if (family.theta_from_tau && family.tau_range(dim).contains(kTau)) return family.from_tau(dim, kTau);
  Theta best = family.examples.front();
  for (const Theta& theta : family.examples) {
    const double tau = family.tau(theta);
    if (tau < kTau && tau > family.tau(best)) best = theta;
  }
  return best;
}

/// The same generator as a user would give it: as text, without closed forms.
FamilyInfo as_formula(const FamilyInfo& family) {
  symbolic::FamilyDefinition definition;
  definition.name = family.name + "_formula";
  definition.title = family.title;
  definition.psi = family.psi;
  definition.source = family.source;
  for (const ParameterInfo& parameter : family.parameters) {
    definition.parameters.push_back({.name = parameter.name, .lowest = "-inf", .highest = "inf"});
  }
  definition.examples = family.examples;
  return symbolic::make_family(definition);
}

using Evaluate = Column (Copula::*)(const PointsRef&) const;

struct Quantity {
  const char* name;
  Evaluate evaluate;
};

constexpr Quantity kQuantities[] = {{"log_pdf", &Copula::log_pdf}, {"h", &Copula::h}, {"h_inv", &Copula::h_inv}};

void measure(benchmark::State& state, const CopulaPtr& copula, Evaluate evaluate, const Points& u) {
  for (auto _ : state) benchmark::DoNotOptimize(((*copula).*evaluate)(u).data());
  state.SetItemsProcessed(state.iterations() * u.rows());
}

void measure_sample(benchmark::State& state, const CopulaPtr& copula, Index rows) {
  Rng rng(1);
  for (auto _ : state) benchmark::DoNotOptimize(copula->sample(rows, rng).data());
  state.SetItemsProcessed(state.iterations() * rows);
}

/// One scalar exp and one log of the C library a row: the unit in which times can be quoted on any machine.
void baseline(benchmark::State& state) {
  Rng rng(1);
  const Points x = uniforms(rng, kRows, 1);
  Column out(kRows);
  for (auto _ : state) {
    for (Index i = 0; i < kRows; ++i) out(i) = std::exp(x(i, 0)) + std::log(x(i, 0));
    benchmark::DoNotOptimize(out.data());
  }
  state.SetItemsProcessed(state.iterations() * kRows);
}

void add(const std::string& prefix, const FamilyInfo& family, const FamilyInfo& points_of, int dim, Index rows) {
  const Theta theta = parameter(points_of, dim);
  const CopulaPtr copula = family.make(dim, theta);
  Rng rng(2);
  const Points u = points_of.make(dim, theta)->sample(rows, rng);
  const std::string suffix = "/" + points_of.name + "/d=" + std::to_string(dim) + "/n=" + std::to_string(rows);
  for (const auto& [name, evaluate] : kQuantities) {
    benchmark::RegisterBenchmark((prefix + name + suffix).c_str(), measure, copula, evaluate, u);
  }
  benchmark::RegisterBenchmark((prefix + "sample" + suffix).c_str(), measure_sample, copula, rows);
}

/// All derivatives of psi up to an order from its text, and the tape of the last.
void differentiate(benchmark::State& state, const std::string& psi, const std::vector<std::string>& symbols,
                   int order) {
  std::size_t nodes = 0, instructions = 0;
  for (auto _ : state) {
    const symbolic::Expression last = symbolic::derivative(symbolic::parse(psi), symbolic::symbol("t"), order);
    const symbolic::Tape tape({last}, symbols);
    nodes = symbolic::node_count(last);
    instructions = tape.instructions().size();
  }
  state.SetLabel(std::to_string(nodes) + " " + std::to_string(instructions));
}

void add_derivatives(const FamilyInfo& family) {
  std::vector<std::string> symbols{"t"};
  for (const ParameterInfo& parameter : family.parameters) symbols.push_back(parameter.name);
  for (const int order : {1, 2, 4, 6, 8, 10, 12, 20, 50, 100}) {
    const std::string name = "derive/" + family.name + "/order=" + std::to_string(order);
    benchmark::RegisterBenchmark(name.c_str(), differentiate, family.psi, symbols, order);
  }
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::RegisterBenchmark("baseline/exp_log", baseline);
  for (const FamilyInfo& family : families::all()) {
    add_derivatives(family);
    for (const int dim : {2, 3, 10, 100}) add("", family, family, dim, kRows);
    if (family.parameters.empty()) continue;
    const FamilyInfo formula = as_formula(family);
    for (const int dim : {2, 3, 10}) add("formula/", formula, family, dim, kFormulaRows);
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
