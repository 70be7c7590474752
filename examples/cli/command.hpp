#pragma once
/// The frame of every subcommand: the options all of them take, and one function a subcommand that adds it.

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace sklar::cli {

struct Common {
  bool json = false;
  std::uint64_t seed = 1;
  int threads = 0;            ///< 0 = as many as the machine has
  std::function<void()> job;  ///< what the chosen subcommand does, run after all arguments are understood
};

/// Adds --json, --seed and --threads, and makes job what runs when this subcommand is chosen. Common outlives the
/// parser.
void finish_command(CLI::App& command, Common& common, std::function<void()> job);

/// Lets the formula of `copula derive` open with a minus.
void protect_formula(std::vector<std::string>& arguments);

void add_families(CLI::App& parent, Common& common);
void add_brdf_albedo(CLI::App& parent, Common& common);
void add_brdf_batch(CLI::App& parent, Common& common);
void add_brdf_compare(CLI::App& parent, Common& common);
void add_brdf_converge(CLI::App& parent, Common& common);
void add_brdf_convert(CLI::App& parent, Common& common);
void add_brdf_eval(CLI::App& parent, Common& common);
void add_brdf_fit(CLI::App& parent, Common& common);
void add_brdf_render(CLI::App& parent, Common& common);
void add_brdf_sample(CLI::App& parent, Common& common);
void add_copula_derive(CLI::App& parent, Common& common);
void add_copula_fit(CLI::App& parent, Common& common);
void add_copula_plot(CLI::App& parent, Common& common);
void add_copula_predict(CLI::App& parent, Common& common);
void add_copula_sample(CLI::App& parent, Common& common);
void add_copula_table(CLI::App& parent, Common& common);
void add_copula_test(CLI::App& parent, Common& common);
void add_tradeoff(CLI::App& parent, Common& common);

}  // namespace sklar::cli
