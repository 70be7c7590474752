#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "brdf/study/base64.hpp"
#include "brdf/study/convergence.hpp"
#include "brdf/study/results.hpp"
#include "copula/file.hpp"
#include "examples/cli/command.hpp"
#include "examples/cli/material.hpp"
#include "examples/cli/report.hpp"
#include "examples/cli/scene.hpp"
#include "examples/cli/text.hpp"

namespace sklar::cli {
namespace {

constexpr int kSheetSamples = 16;  // of the conditional sampler, in the sheet of pictures

struct Options {
  std::vector<std::string> materials;
  std::string scene = "room";
  std::string size = "128";
  int samples = 256;
  int reference = 0;
  std::uint64_t seed = 1;
  std::filesystem::path folder = "out";
};

using Rows = std::vector<brdf::ConvergenceRow>;

std::string printed(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

/// One bar over all pictures, each counted by its samples.
class Work {
 public:
  explicit Work(double samples) : bar_(progress_bar("rendering")), all_(samples) {}

  /// Of the picture that is rendered next.
  [[nodiscard]] brdf::Progress next(double samples) {
    const double before = done_;
    done_ += samples;
    if (!bar_) return {};
    return [this, before, samples](double share) { bar_(std::min((before + share * samples) / all_, 1.0)); };
  }

 private:
  brdf::Progress bar_;
  double all_, done_ = 0;
};

Rows measure(const std::vector<brdf::Drawing>& drawings, const brdf::ReferencePair& reference, const Options& options,
             Work& work) {
  Rows rows;
  for (int samples = 1; samples <= options.samples; samples *= 2) {
    for (const brdf::Drawing& drawing : drawings) {
      rows.push_back(measure_picture(drawing, reference, samples, options.seed, work.next(samples)).row);
    }
    write_file(options.folder / "convergence.csv", convergence_csv(rows));  // what is finished stays
  }
  std::stable_sort(rows.begin(), rows.end(), [&](const auto& a, const auto& b) {
    const auto place = [&](const std::string& name) {
      return std::find_if(drawings.begin(), drawings.end(), [&](const auto& drawing) { return drawing.name == name; });
    };
    return place(a.sampler) < place(b.sampler);
  });
  write_file(options.folder / "convergence.csv", convergence_csv(rows));
  return rows;
}

/// Pictures that took as long as the conditional sampler's of kSheetSamples, beside the reference.
void write_sheet(const std::vector<brdf::Drawing>& drawings, const brdf::ReferencePair& reference, const Rows& rows,
                 const Options& options, const std::filesystem::path& path) {
  const brdf::Image truth = around_materials(reference.mean(), reference);
  const double exposure = drawings.front().scene.exposure;
  const auto seconds_a_sample = [&](const std::string& name) {
    const auto last = std::find_if(rows.rbegin(), rows.rend(), [&](const auto& row) { return row.sampler == name; });
    return last->seconds / last->samples;
  };
  const int most = std::min(kSheetSamples, options.samples);
  const double budget = most * seconds_a_sample(drawings.front().name);
  plot::ImageGrid grid;
  grid.title = "equal time";
  grid.rows.resize(1);
  for (const brdf::Drawing& drawing : drawings) {
    const int samples = std::max(1, static_cast<int>(std::lround(budget / seconds_a_sample(drawing.name))));
    const auto [row, image] = measure_picture(drawing, reference, samples, options.seed);
    const double error = std::isnan(row.errors.of_materials) ? row.errors.rms : row.errors.of_materials;
    grid.rows[0].push_back({to_srgb(around_materials(image, reference), exposure),
                            std::to_string(samples) + " samples, " + printed("error %.3f", error)});
    grid.column_labels.push_back(drawing.name);
  }
  grid.rows[0].push_back({to_srgb(truth, exposure), std::to_string(2 * options.reference) + " samples"});
  grid.column_labels.emplace_back("reference");
  plot::write_grid(path, grid);
}

std::string table(const Rows& rows) {
  std::vector<Cells> cells = {{"sampler", "samples", "seconds", "rms", "relative", "of_materials"}};
  for (const brdf::ConvergenceRow& row : rows) {
    cells.push_back({row.sampler, std::to_string(row.samples), printed("%.3g", row.seconds),
                     printed("%.4f", row.errors.rms), printed("%.4f", row.errors.relative),
                     printed("%.4f", row.errors.of_materials)});
  }
  return aligned(cells);
}

/// The errors of the others over those of the conditional sampler: at the most samples, and in equal time.
std::string ratios(const Rows& rows, const std::vector<brdf::Drawing>& drawings) {
  const double seconds = common_seconds(rows);
  const std::string& ours = drawings.front().name;
  std::vector<Cells> cells = {{"error / " + ours, "in", "rms", "relative", "of_materials"}};
  const auto last = [&](const std::string& name) {
    return std::find_if(rows.rbegin(), rows.rend(), [&](const auto& row) { return row.sampler == name; });
  };
  using Error = double brdf::PictureErrors::*;
  constexpr Error kErrors[] = {&brdf::PictureErrors::rms, &brdf::PictureErrors::relative,
                               &brdf::PictureErrors::of_materials};
  for (const brdf::Drawing& drawing : drawings) {
    if (drawing.name == ours) continue;
    Cells samples = {drawing.name, std::to_string(last(ours)->samples) + " samples"};
    Cells time = {drawing.name, printed("%.3g seconds", seconds)};
    for (const Error error : kErrors) {
      samples.push_back(printed("%.2f", last(drawing.name)->errors.*error / (last(ours)->errors.*error)));
      time.push_back(
          printed("%.2f", error_at(rows, drawing.name, error, seconds) / error_at(rows, ours, error, seconds)));
    }
    cells.push_back(samples);
    cells.push_back(time);
  }
  return aligned(cells);
}

nlohmann::ordered_json json_of(const Rows& rows) {
  nlohmann::ordered_json result = nlohmann::ordered_json::array();
  for (const brdf::ConvergenceRow& row : rows) {
    result.push_back({{"sampler", row.sampler},
                      {"samples", row.samples},
                      {"seconds", json_number(row.seconds)},
                      {"rms", json_number(row.errors.rms)},
                      {"relative", json_number(row.errors.relative)},
                      {"of_materials", json_number(row.errors.of_materials)}});
  }
  return {{"rows", result}};
}

/// @param sheet the file of the pictures.
void write_report(const Rows& rows, const std::string& title, const std::filesystem::path& sheet,
                  const Options& options) {
  nlohmann::ordered_json document = json_of(rows);
  document["scene"] = title;
  document["machine"] = brdf::machine_name();
  document["picture"] = "data:image/png;base64," + brdf::base64(read_file(sheet));
  write_cost_report((options.folder / "report.html").string(), "Convergence", "convergence", document);
}

void run(Options options, bool json) {
  std::vector<brdf::BrdfPtr> materials;
  for (const std::string& path : options.materials) materials.push_back(load_isotropic_brdf(path));
  if (materials.empty()) materials.push_back(load_isotropic_brdf(""));
  brdf::Scene scene = load_scene(options.scene, materials);
  set_size(options.size, scene.width, scene.height);
  brdf::require_scene(scene);
  make_folder(options.folder);
  const auto drawings = brdf::drawings(scene, materials);
  if (options.reference == 0) options.reference = 4 * options.samples;
  int each = 0;
  for (int samples = 1; samples <= options.samples; samples *= 2) each += samples;
  Work work(2.0 * options.reference + static_cast<double>(drawings.size()) * each);
  brdf::ReferencePair reference = render_references(drawings.front().scene, options.reference, options.seed + 1,
                                                    work.next(2.0 * options.reference));
  reference.of_materials = brdf::pixels_of(scene, materials);
  const Rows rows = measure(drawings, reference, options, work);
  const std::string title = std::filesystem::path(options.scene).stem().string() + ", " + std::to_string(scene.width) +
                            " x " + std::to_string(scene.height) + " pixels";
  const auto file = [&](const char* name) { return options.folder / name; };
  plot::write_page(file("convergence.png"), convergence_page(rows, title));
  plot::write_page(file("convergence.svg"), convergence_page(rows, title));
  write_sheet(drawings, reference, rows, options, file("equal_time.png"));
  write_report(rows, title, file("equal_time.png"), options);
  if (json) {
    print_json(json_of(rows));
    return;
  }
  std::cout << table(rows) << '\n' << ratios(rows, drawings) << '\n';
  for (const char* name : {"convergence.csv", "convergence.png", "convergence.svg", "equal_time.png", "report.html"}) {
    std::cout << file(name).string() << '\n';
  }
}

}  // namespace

void add_brdf_converge(CLI::App& parent, Common& common) {
  CLI::App* command = parent.add_subcommand("converge", "the error of a path traced scene by samples and by time");
  const auto options = std::make_shared<Options>();
  command->add_option("MATERIAL", options->materials,
                      "isotropic material files (.binary, .bsdf) or models; omitted: the built-in material");
  command->add_option("--scene", options->scene, "as of brdf render; sphere is path traced as well")
      ->check(check_scene)
      ->type_name(kSceneNames)
      ->capture_default_str();
  command->add_option("--size", options->size, "pixels, or the height alone")->type_name("WxH")->capture_default_str();
  command->add_option("--spp-max", options->samples, "paths a pixel go in powers of two up to this")
      ->check(CLI::Range(1, 1 << 20))
      ->capture_default_str();
  command
      ->add_option("--spp-reference", options->reference,
                   "paths a pixel of each of two references; by default four times --spp-max")
      ->check(CLI::Range(1, 1 << 22));
  command->add_option("--out", options->folder, "folder for the table and the pictures")->capture_default_str();
  finish_command(*command, common, [options, &common] {
    options->seed = common.seed;
    run(*options, common.json);
  });
}

}  // namespace sklar::cli
