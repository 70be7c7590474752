/// Nanoseconds a row over the list of families on one thread: the library, the same from the formula of psi alone, and
/// the baselines, one scalar exp and log of the C library and scalar textbook formulas. Names:
/// log_pdf/frank/d=2/n=65536, with fast/, formula/ or textbook/ before them; fit/frank/d=2/n=100000, large_fit;
/// derive/frank/order=10. Run by tests/bench.sh.

#include <benchmark/benchmark.h>
#include <oneapi/tbb/global_control.h>
#include <sys/resource.h>

#include <cmath>
#include <functional>
#include <stdexcept>
#include <tuple>

#include "copula/inference/fit.hpp"
#include "copula/study/tradeoff.hpp"
#include "copula/symbolic/derivative.hpp"
#include "copula/symbolic/formula_family.hpp"
#include "copula/symbolic/parser.hpp"
#include "copula/symbolic/tape.hpp"
#include "families/registry.hpp"
#include "tests/bench/textbook.hpp"

namespace {

using namespace sklar;

constexpr Index kRows = 65536;
constexpr Index kRowsOfManyDimensions = 1024;
constexpr Index kGrowthRows = 4096;
constexpr Index kFormulaRows = 1024;
constexpr Index kFitRows = 100'000, kManyFitRows = 10'000'000;

std::string suffix(const FamilyInfo& family, int dim, Index rows) {
  return "/" + family.name + "/d=" + std::to_string(dim) + "/n=" + std::to_string(rows);
}

/// Points of a family at medium_theta. The last ones are kept: a benchmark asks for its own several times.
const Points& points(const FamilyInfo& family, int dim, Index rows) {
  static std::tuple<std::string, int, Index> kept;
  static Points u;
  const std::tuple wanted(family.name, dim, rows);
  if (kept != wanted) {
    Rng rng(2);
    u = family.make(dim, medium_theta(family, dim))->sample_by(Route::radial, rows, rng);
    kept = wanted;
  }
  return u;
}

using Evaluate = Column (Copula::*)(const PointsRef&, Accuracy) const;

struct Evaluation {
  const char* name;
  Evaluate evaluate;
};

constexpr Evaluation kEvaluations[] = {{"log_pdf", &Copula::log_pdf}, {"h", &Copula::h}, {"h_inv", &Copula::h_inv}};

/// The library's quantities of one copula.
struct Subject {
  const FamilyInfo& family;  ///< of the points
  CopulaPtr copula;
  int dim;
  Index rows;

  void add(const std::string& prefix, const Evaluation& evaluation, Accuracy accuracy = Accuracy::standard) const {
    const auto measure = [*this, evaluate = evaluation.evaluate, accuracy](benchmark::State& state) {
      const Points& u = points(family, dim, rows);
      for (auto _ : state) benchmark::DoNotOptimize(((*copula).*evaluate)(u, accuracy).data());
      state.SetItemsProcessed(state.iterations() * rows);
    };
    benchmark::RegisterBenchmark((prefix + evaluation.name + suffix(family, dim, rows)).c_str(), measure);
  }

  void add_sample(const std::string& prefix) const {
    const auto measure = [*this](benchmark::State& state) {
      Rng rng(1);
      for (auto _ : state) benchmark::DoNotOptimize(copula->sample(rows, rng).data());
      state.SetItemsProcessed(state.iterations() * rows);
    };
    benchmark::RegisterBenchmark((prefix + "sample" + suffix(family, dim, rows)).c_str(), measure);
  }

  void add_all(const std::string& prefix) const {
    for (const Evaluation& evaluation : kEvaluations) add(prefix, evaluation);
    add_sample(prefix);
  }
};

Subject subject(const FamilyInfo& family, int dim, Index rows) {
  return {family, family.make(dim, medium_theta(family, dim)), dim, rows};
}

/// One scalar exp and one log of the C library a row: the unit in which times can be quoted on any machine.
void exp_log(benchmark::State& state) {
  Rng rng(1);
  const Points x = uniforms(rng, kRows, 1);
  Column out(kRows);
  for (auto _ : state) {
    for (Index i = 0; i < kRows; ++i) out(i) = std::exp(x(i, 0)) + std::log(x(i, 0));
    benchmark::DoNotOptimize(out.data());
  }
  state.SetItemsProcessed(state.iterations() * kRows);
}

/// A baseline that computes something else would be no baseline. @throws std::logic_error
void require_agreement(const std::string& name, const Column& values, const Column& expected) {
  constexpr double kMost = 1e-8;
  const double worst = ((values - expected).abs() / expected.abs().max(1)).maxCoeff();
  if (!(worst <= kMost)) throw std::logic_error(name + ": the baseline is off by " + std::to_string(worst));
}

using Scalar = std::function<double(double u, double v)>;

void add_textbook(const FamilyInfo& family, const char* quantity, const Scalar& value, Evaluate expected) {
  const auto fill = [value](const Points& u, Column& out) {
    for (Index i = 0; i < u.rows(); ++i) out(i) = value(u(i, 0), u(i, 1));
  };
  const std::string name = std::string("textbook/") + quantity + suffix(family, 2, kRows);
  const Points& sample = points(family, 2, kRows);
  Column values(kRows);
  fill(sample, values);
  require_agreement(name, values, ((*subject(family, 2, kRows).copula).*expected)(sample, Accuracy::standard));
  const auto measure = [fill, &family](benchmark::State& state) {
    const Points& u = points(family, 2, kRows);
    Column out(kRows);
    for (auto _ : state) {
      fill(u, out);
      benchmark::DoNotOptimize(out.data());
    }
  };
  benchmark::RegisterBenchmark(name.c_str(), measure);
}

/// The quantities that everyone computes, by the formulas that everyone uses. A call through std::function a row is
/// small beside them.
template <class Textbook>
void add_textbook(const char* name) {
  const FamilyInfo& family = families::find(name);
  const Textbook copula{medium_theta(family, 2).front()};
  const Scalar log_pdf = [copula](double u, double v) { return copula.log_pdf(u, v); };
  const Scalar h_inv = [copula](double u, double p) { return copula.h_inv(u, p); };
  add_textbook(family, "log_pdf", log_pdf, &Copula::log_pdf);
  add_textbook(family, "h_inv", h_inv, &Copula::h_inv);
  const auto measure = [h_inv](benchmark::State& state) {
    Rng rng(1);
    Points out(kRows, 2);
    for (auto _ : state) {
      for (Index i = 0; i < kRows; ++i) {
        out(i, 0) = uniform(rng);
        out(i, 1) = h_inv(out(i, 0), uniform(rng));
      }
      benchmark::DoNotOptimize(out.data());
    }
  };
  benchmark::RegisterBenchmark(("textbook/sample" + suffix(family, 2, kRows)).c_str(), measure);
}

/// The most memory that this process has held, in MiB.
long peak_memory() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss / 1024;
}

void add_fit(const FamilyInfo& family) {
  const auto measure = [&family](benchmark::State& state) {
    const Points& u = points(family, 2, kFitRows);
    for (auto _ : state) benchmark::DoNotOptimize(fit_maximum_likelihood(family, u).theta.data());
  };
  benchmark::RegisterBenchmark(("fit" + suffix(family, 2, kFitRows)).c_str(), measure);
}

/// Labelled with what it raises the peak of memory by, in MiB.
void add_large_fit(const FamilyInfo& family) {
  const auto measure = [&family](benchmark::State& state) {
    Rng rng(2);
    const Points u = family.make(2, medium_theta(family, 2))->sample(kManyFitRows, rng);
    const long before = peak_memory();
    for (auto _ : state) benchmark::DoNotOptimize(fit_maximum_likelihood(family, u).theta.data());
    state.SetLabel(std::to_string(peak_memory() - before));
  };
  benchmark::RegisterBenchmark(("large_fit" + suffix(family, 2, kManyFitRows)).c_str(), measure)
      ->Iterations(1)
      ->Repetitions(3)
      ->Unit(benchmark::kNanosecond);
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

/// The log density in more and more dimensions, and rows.
void add_growth(const FamilyInfo& family) {
  for (const int dim : {2, 5, 10, 20, 50, 100}) subject(family, dim, kGrowthRows).add("", kEvaluations[0]);
  for (const Index rows : {1000, 10'000, 100'000, 1'000'000}) subject(family, 2, rows).add("", kEvaluations[0]);
}

void add_family(const FamilyInfo& family) {
  add_derivatives(family);
  for (const int dim : {2, 3}) subject(family, dim, kRows).add_all("");
  for (const int dim : {10, 100}) subject(family, dim, kRowsOfManyDimensions).add_all("");
  if (family.parameters.empty()) return;
  for (const Evaluation& evaluation : kEvaluations) subject(family, 2, kRows).add("fast/", evaluation, Accuracy::fast);
  add_growth(family);
  add_fit(family);
  add_large_fit(family);
  const FamilyInfo formula = symbolic::formula_of(family);
  for (const int dim : {2, 3, 10}) {
    Subject{family, formula.make(dim, medium_theta(family, dim)), dim, kFormulaRows}.add_all("formula/");
  }
}

}  // namespace

int main(int argc, char** argv) {
  const oneapi::tbb::global_control one_thread(oneapi::tbb::global_control::max_allowed_parallelism, 1);
  benchmark::RegisterBenchmark("baseline/exp_log", exp_log);
  add_textbook<textbook::Frank>("frank");
  add_textbook<textbook::Clayton>("clayton");
  add_textbook<textbook::Gumbel>("gumbel");
  add_textbook<textbook::Joe>("joe");
  add_textbook<textbook::Amh>("amh");
  for (const FamilyInfo& family : families::all()) add_family(family);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
