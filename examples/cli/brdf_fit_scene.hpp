#pragma once
/// `brdf fit --scene`: the smallest model that a scene allows.

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

#include "brdf/study/scene_fit.hpp"
#include "examples/cli/fit_options.hpp"

namespace sklar::cli {

struct SceneOptions {
  std::string scene;  ///< empty: none
  std::string size;
  int samples = 16;
};

void add_scene_options(CLI::App& command, SceneOptions& options);

/// @param text 40dB, a PSNR at least, or 0.5dE, a mean CIEDE2000 at most. @throws std::invalid_argument for another.
[[nodiscard]] brdf::ImageTolerance parse_tolerance(const std::string& text);

/// Fits, writes the model and, beside it, MODEL_scene.png; prints what was tried.
void run_scene_fit(const brdf::MeasuredTable& table, const SceneOptions& options, const FitOptions& fit,
                   const brdf::ImageTolerance& tolerance, std::uint64_t seed, const std::string& output, bool json);

}  // namespace sklar::cli
