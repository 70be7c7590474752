#include <algorithm>
#include <atomic>
#include <charconv>
#include <cmath>
#include <csignal>
#include <iostream>
#include <memory>

#include "brdf/study/model_batch.hpp"
#include "copula/study/timing.hpp"
#include "examples/cli/command.hpp"
#include "examples/cli/fit_options.hpp"
#include "examples/cli/material.hpp"
#include "examples/cli/material_list.hpp"
#include "examples/cli/model_tables.hpp"
#include "examples/cli/text.hpp"

namespace sklar::cli {
namespace {

/// Share `index` of `count` of the materials.
struct Part {
  std::size_t index = 1, count = 1;
};

struct Options {
  std::vector<std::string> materials;
  std::string models = "refined";
  std::vector<double> budgets = {1024, 4096, 16384};
  std::string folder;
  brdf::Provenance provenance = brdf::Provenance::unknown;
  bool retry_failed = false;
  std::string part;
};

std::atomic<bool> interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may set no other");

/// The first SIGINT or SIGTERM lets the jobs that run finish, the second ends the program.
void end_cleanly_on_signals() {
  struct sigaction action = {};
  action.sa_handler = [](int) { interrupted = true; };
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  for (const int signal : {SIGINT, SIGTERM}) sigaction(signal, &action, nullptr);
}

/// A whole text as a number, 0 for any other.
std::size_t whole_number(std::string_view text) {
  std::size_t number = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && stop == end ? number : 0;
}

Part parse_part(const std::string& text) {
  if (text.empty()) return {};
  const std::size_t slash = std::min(text.find('/'), text.size() - 1);
  const Part part{whole_number(std::string_view(text).substr(0, slash)),
                  whole_number(std::string_view(text).substr(slash + 1))};
  if (1 <= part.index && part.index <= part.count) return part;
  throw std::invalid_argument("--part " + text + ": must be I/N with 1 <= I <= N, as 2/10");
}

/// Models that learn from other materials would need all of them in memory.
std::vector<brdf::Contender> contenders_of(const Options& options) {
  auto contenders = parse_contenders(options.models, options.budgets);
  if (options.models == kAllModels) std::erase_if(contenders, [](const auto& contender) { return contender.learns; });
  for (const brdf::Contender& contender : contenders) {
    if (!contender.learns) continue;
    throw std::invalid_argument("--models " + contender.model +
                                ": learns from the other materials; `sklar brdf compare` fits it");
  }
  return contenders;
}

std::vector<brdf::BatchMaterial> materials_of(const Options& options, const Part& part) {
  const auto listed = listed_materials(options.materials);
  std::vector<brdf::BatchMaterial> materials;
  for (std::size_t n = part.index - 1; n < listed.size(); n += part.count) {
    const std::string& path = listed[n].path;
    const brdf::Provenance provenance = options.provenance;
    materials.push_back({.name = listed[n].name,
                         .provenance = provenance,
                         .inputs = [path, provenance] { return inputs_of(path, provenance); },
                         .load = [path, provenance] { return load_table(path, provenance); }});
  }
  return materials;
}

/// To the minute from an hour on.
std::string duration(double seconds) {
  const long whole = std::lround(seconds);
  if (whole < 60) return std::to_string(whole) + " s";
  const long minutes = whole / 60;
  if (minutes < 60) return std::to_string(minutes) + " min " + std::to_string(whole % 60) + " s";
  return std::to_string(minutes / 60) + " h " + std::to_string(minutes % 60) + " min";
}

/// @param seconds since the begin. The time left is that of the jobs left at the pace so far.
std::string progress_text(const brdf::BatchState& state, const std::string& job, double seconds) {
  const std::size_t finished = state.kept + state.done;
  std::string text = std::to_string(finished) + " of " + std::to_string(state.jobs) + " jobs";
  if (state.failed > 0) text += ", " + std::to_string(state.failed) + " failed";
  if (state.done > 0) {
    const double pace = seconds / static_cast<double>(state.done);
    text += ", " + duration(pace * static_cast<double>(state.jobs - finished)) + " left";
  }
  return text + "; " + job;
}

std::vector<brdf::ModelRow> fit(const Options& options, const std::vector<brdf::BatchMaterial>& materials,
                                const std::vector<brdf::Contender>& contenders) {
  const StepLine steps;
  const Stopwatch stopwatch;
  return brdf::fit_batch(
      materials, contenders, options.folder,
      {.retry_failed = options.retry_failed, .progress = [&](const brdf::BatchState& state, const std::string& job) {
         if (interrupted) {
           throw std::runtime_error("interrupted; what is done is kept, the same command goes on");
         }
         steps.show(progress_text(state, job, stopwatch.seconds()));
       }});
}

void run(const Options& options, bool json) {
  const Part part = parse_part(options.part);
  const auto contenders = contenders_of(options);
  const auto materials = materials_of(options, part);
  end_cleanly_on_signals();
  const std::vector<brdf::ModelRow> rows = fit(options, materials, contenders);
  std::vector<std::filesystem::path> files;
  if (part.count == 1) files = write_model_tables(options.folder, rows, options.models == kAllModels);
  if (json) {
    std::cout << to_json(rows);
  } else {
    print_models(rows);
    for (const auto& file : files) std::cout << file.string() << '\n';
  }
  const auto failed = std::count_if(rows.begin(), rows.end(), [](const auto& row) { return !row.error.empty(); });
  if (failed == 0) return;
  throw std::runtime_error(std::to_string(failed) + " of " + std::to_string(rows.size()) + " jobs failed");
}

}  // namespace

void add_brdf_batch(CLI::App& parent, Common& common) {
  CLI::App* command =
      parent.add_subcommand("batch", "fit models to many materials, each result a file; goes on where it was");
  const auto options = std::make_shared<Options>();
  command
      ->add_option("LIST", options->materials,
                   "a list of isotropic materials, LIST.txt with a path a line relative to its folder, or their files")
      ->required();
  command->add_option("--models", options->models, "all, or names with commas")->capture_default_str();
  command->add_option("--budgets", options->budgets, "sizes in bytes of models that come in any size")
      ->delimiter(',')
      ->capture_default_str();
  command->add_option("--out", options->folder, "folder for MATERIAL/MODEL.json and the tables of all")->required();
  command->add_option("--part", options->part,
                      "I/N: every Nth material from the Ith on, and no tables; once all parts are done, the command "
                      "without --part writes them");
  command->add_flag("--retry-failed", options->retry_failed, "repeat what has failed");
  add_provenance(*command, options->provenance);
  finish_command(*command, common, [options, &common] { run(*options, common.json); });
}

}  // namespace sklar::cli
