/// Nanoseconds of one call at a time of a refined model and its sampler, on one thread: tests/sampling.sh. Names:
/// quantity/one has calls that do not depend on each other, quantity/waiting calls each of which needs the last.
/// The first argument is a material file; without one it is the built-in material.

#include <benchmark/benchmark.h>
#include <oneapi/tbb/global_control.h>

#include <cmath>
#include <iostream>
#include <numbers>

#include "brdf/analytic/synthetic.hpp"
#include "brdf/data/material.hpp"
#include "brdf/sampling/sampled_brdf.hpp"
#include "brdf/study/refined_budget.hpp"
#include "copula/random.hpp"

namespace sklar::brdf {
namespace {

constexpr std::size_t kCalls = 4096;
constexpr double kBytes = 4096;
constexpr double kNothing = 1e-300;  // by which a call depends on the last

struct Arguments {
  std::vector<Vec3> wo, wi;
  std::vector<Vec2> uniforms;

  Arguments() {
    Rng rng(1);
    const auto direction = [&] {
      const double z = uniform(rng), phi = 2 * std::numbers::pi * uniform(rng), radius = std::sqrt(1 - z * z);
      return Vec3(radius * std::cos(phi), radius * std::sin(phi), z);
    };
    for (std::size_t i = 0; i < kCalls; ++i) {
      wo.push_back(direction());
      wi.push_back(direction());
      const double first = uniform(rng);
      uniforms.emplace_back(first, uniform(rng));
    }
  }
};

template <bool Waiting, class Call>
void repeat(benchmark::State& state, const Call& call) {
  for (auto _ : state) {
    double sum = 0, last = 0;
    for (std::size_t i = 0; i < kCalls; ++i) {
      if constexpr (Waiting) {
        last = call(i, kNothing * last);
      } else {
        last = call(i, 0.0);
      }
      sum += last;
    }
    benchmark::DoNotOptimize(sum);
  }
}

/// @param call of (i, nothing): what call i gives, `nothing` to be added to an argument.
template <class Call>
void add(const std::string& name, const Call& call) {
  benchmark::RegisterBenchmark((name + "/one").c_str(),
                               [call](benchmark::State& state) { repeat<false>(state, call); });
  benchmark::RegisterBenchmark((name + "/waiting").c_str(),
                               [call](benchmark::State& state) { repeat<true>(state, call); });
}

/// sample_pdf_and_value of all calls in batches.
void add_batch(const std::shared_ptr<const SampledBrdf>& model, const Arguments& at) {
  Directions wo(kCalls, 3);
  Eigen::ArrayX2d uniforms(kCalls, 2);
  for (std::size_t i = 0; i < kCalls; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    wo.row(row) = at.wo[i].transpose();
    uniforms.row(row) = at.uniforms[i].transpose();
  }
  benchmark::RegisterBenchmark("sample_pdf_and_value/batch", [=](benchmark::State& state) {
    for (auto _ : state) {
      const Samples samples = model->sample(wo, uniforms);
      benchmark::DoNotOptimize(samples.weight.data());
    }
  });
}

MeasuredTable material(int argc, char** argv) {
  return argc > 1 && argv[1][0] != '-' ? load_material(argv[1]) : builtin_material();
}

void run(int argc, char** argv) {
  const RefinedFitOptions options{.structure = largest_structure(kBytes, kLadderBits), .bits = kLadderBits};
  const auto model = std::make_shared<const SampledBrdf>(fit_refined(material(argc, argv), options).brdf);
  const auto at = std::make_shared<const Arguments>();
  const auto moved = [](const Vec3& w, double nothing) { return Vec3(w.x() + nothing, w.y() + nothing, w.z()); };
  add("exp_log", [=](std::size_t i, double nothing) { return std::log(1 + std::exp(at->wi[i].x() + nothing)); });
  add("value", [=](std::size_t i, double nothing) { return model->eval(at->wo[i], moved(at->wi[i], nothing)).sum(); });
  add("pdf", [=](std::size_t i, double nothing) { return model->pdf(at->wo[i], moved(at->wi[i], nothing)); });
  add("sample_and_pdf", [=](std::size_t i, double nothing) {
    return model->sampler().draw(moved(at->wo[i], nothing), at->uniforms[i]).pdf;
  });
  add("sample_pdf_and_value", [=](std::size_t i, double nothing) {
    const Sample sample = model->sample(moved(at->wo[i], nothing), at->uniforms[i]);
    return sample.pdf + sample.weight.sum();
  });
  add_batch(model, *at);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}

}  // namespace
}  // namespace sklar::brdf

int main(int argc, char** argv) {
  const oneapi::tbb::global_control one_thread(oneapi::tbb::global_control::max_allowed_parallelism, 1);
  try {
    sklar::brdf::run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
