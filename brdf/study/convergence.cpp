#include "brdf/study/convergence.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <limits>
#include <memory>
#include <stdexcept>

#include "brdf/analytic/lambert.hpp"
#include "brdf/render/path_tracer.hpp"
#include "brdf/sampling/drawn_by.hpp"
#include "brdf/sampling/sampled_brdf.hpp"
#include "brdf/study/efficiency.hpp"

namespace sklar::brdf {
namespace {

using plot::Axis;
using plot::Line;
using plot::LinePlot;
using plot::Marker;
using plot::Scale;

constexpr double kDark = 0.01;  ///< of the mean of the picture, added to what differences are relative to
constexpr int kCoverage = 16;   ///< rays that decide what a pixel shows
constexpr Marker kMarkers[] = {Marker::circle, Marker::square, Marker::triangle, Marker::diamond};

bool is_one_of(std::span<const BrdfPtr> materials, const BrdfPtr& material) {
  return material && std::find(materials.begin(), materials.end(), material) != materials.end();
}

/// The scene with materials[k] replaced by replacements[k].
Scene replaced(Scene scene, std::span<const BrdfPtr> materials, std::span<const BrdfPtr> replacements) {
  for (Object& object : scene.objects) {
    const auto found = std::find(materials.begin(), materials.end(), object.material);
    if (!object.material || found == materials.end()) continue;
    object.material = replacements[static_cast<std::size_t>(found - materials.begin())];
  }
  return scene;
}

/// Sums over pixels and channels.
struct Sums {
  double square = 0, value = 0;
  std::size_t count = 0;

  [[nodiscard]] double mean() const { return value / static_cast<double>(count); }
  [[nodiscard]] double rms() const { return std::sqrt(std::max(square, 0.0) / static_cast<double>(count)) / mean(); }
};

std::vector<std::string> samplers_of(std::span<const ConvergenceRow> rows) {
  std::vector<std::string> names;
  for (const ConvergenceRow& row : rows) {
    if (std::find(names.begin(), names.end(), row.sampler) == names.end()) names.push_back(row.sampler);
  }
  return names;
}

/// A logarithmic axis with room for markers at its ends, and ticks at 1, 2 and 5 of each decade.
Axis roomy(const std::string& label, const std::vector<double>& values) {
  constexpr double kRoom = 1.3;
  Axis axis = plot::fitted({.label = label, .scale = Scale::logarithmic}, values);
  axis.low /= kRoom;
  axis.high *= kRoom;
  const auto exponent = [](double value) { return static_cast<int>(std::floor(std::log10(value))); };
  for (int decade = exponent(axis.low); decade <= exponent(axis.high); ++decade) {
    for (const double digit : {1, 2, 5}) {
      const double tick = digit * std::pow(10, decade);
      if (tick >= axis.low && tick <= axis.high) axis.ticks.push_back(tick);
    }
  }
  return axis;
}

}  // namespace

std::vector<Drawing> drawings(const Scene& scene, std::span<const BrdfPtr> materials) {
  const auto cosine = std::make_shared<const Lambert>(Rgb::Ones());
  std::vector<BrdfPtr> conditional, hemisphere, ggx;
  for (const BrdfPtr& material : materials) {
    conditional.push_back(std::make_shared<const SampledBrdf>(material));
    hemisphere.push_back(std::make_shared<const DrawnBy>(material, cosine));
    ggx.push_back(std::make_shared<const DrawnBy>(material, ggx_sampler(*material)));
  }
  return {{"conditional", replaced(scene, materials, conditional)},
          {"cosine", replaced(scene, materials, hemisphere)},
          {"ggx", replaced(scene, materials, ggx)}};
}

Image ReferencePair::mean() const {
  Image image = first;
  for (std::size_t i = 0; i < image.rgb.size(); ++i) image.rgb[i] = (first.rgb[i] + second.rgb[i]) / 2;
  return image;
}

ReferencePair render_references(const Scene& scene, int samples, std::uint64_t seed, const Progress& progress) {
  const auto half = [&](double start) -> Progress {
    if (!progress) return {};
    return [&progress, start](double share) { progress(start + share / 2); };
  };
  ReferencePair pair;
  pair.first = render_paths(scene, {.samples = samples, .seed = seed, .progress = half(0)});
  pair.second = render_paths(scene, {.samples = samples, .seed = seed + 1, .progress = half(0.5)});
  return pair;
}

std::vector<bool> pixels_of(Scene scene, std::span<const BrdfPtr> materials) {
  // Those that are white where nothing else shines.
  bool any = false;
  for (Object& object : scene.objects) {
    const bool shines = is_one_of(materials, object.material);
    object.emission = shines ? Rgb::Ones() : Rgb::Zero();
    any = any || shines;
  }
  std::vector<bool> result(static_cast<std::size_t>(scene.width) * static_cast<std::size_t>(scene.height));
  if (!any) return result;
  scene.lights.clear();
  scene.environment.reset();
  scene.background.reset();
  scene.depth = 0;
  const Image image = render_paths(scene, {.samples = kCoverage});
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = image.rgb[3 * i] == 1.0F;
  return result;
}

PictureErrors picture_errors(const Image& picture, const ReferencePair& reference) {
  const Image &a = reference.first, &b = reference.second;
  if (picture.width != a.width || picture.height != a.height) {
    throw std::invalid_argument("picture_errors: the picture and its reference must have one size");
  }
  Sums all, own;
  const auto product = [&](std::size_t i) {
    return (static_cast<double>(picture.rgb[i]) - a.rgb[i]) * (static_cast<double>(picture.rgb[i]) - b.rgb[i]);
  };
  const auto truth = [&](std::size_t i) { return (static_cast<double>(a.rgb[i]) + b.rgb[i]) / 2; };
  for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
    for (Sums* sums : {&all, &own}) {
      if (sums == &own && (reference.of_materials.empty() || !reference.of_materials[i / 3])) continue;
      sums->square += product(i);
      sums->value += truth(i);
      ++sums->count;
    }
  }
  double relative = 0;
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
    const double scale = (truth(i) + truth(i + 1) + truth(i + 2)) / 3 + kDark * all.mean();
    relative += (product(i) + product(i + 1) + product(i + 2)) / (scale * scale);
  }
  return {.rms = all.rms(),
          .relative = std::sqrt(std::max(relative, 0.0) / static_cast<double>(all.count)),
          .of_materials = own.count > 0 ? own.rms() : std::numeric_limits<double>::quiet_NaN()};
}

MeasuredPicture measure_picture(const Drawing& drawing, const ReferencePair& reference, int samples, std::uint64_t seed,
                                const Progress& progress) {
  const std::clock_t start = std::clock();
  Image image = render_paths(drawing.scene, {.samples = samples, .seed = seed, .progress = progress});
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  const PictureErrors errors = picture_errors(image, reference);
  return {{drawing.name, samples, seconds, errors}, std::move(image)};
}

double error_at(std::span<const ConvergenceRow> rows, const std::string& sampler, double PictureErrors::*error,
                double seconds) {
  const ConvergenceRow* before = nullptr;
  for (const ConvergenceRow& row : rows) {
    if (row.sampler != sampler) continue;
    if (row.seconds == seconds) return row.errors.*error;
    if (before && before->seconds < seconds && seconds < row.seconds) {
      const double share = std::log(seconds / before->seconds) / std::log(row.seconds / before->seconds);
      return std::pow(before->errors.*error, 1 - share) * std::pow(row.errors.*error, share);
    }
    before = &row;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

double common_seconds(std::span<const ConvergenceRow> rows) {
  double least = std::numeric_limits<double>::infinity();
  for (const std::string& sampler : samplers_of(rows)) {
    double most = 0;
    for (const ConvergenceRow& row : rows) {
      if (row.sampler == sampler) most = std::max(most, row.seconds);
    }
    least = std::min(least, most);
  }
  return least;
}

Image around_materials(const Image& picture, const ReferencePair& reference) {
  if (reference.of_materials.empty()) return picture;
  int top = picture.height, bottom = 0, left = picture.width, right = 0;
  for (int row = 0; row < picture.height; ++row) {
    for (int column = 0; column < picture.width; ++column) {
      if (!reference.of_materials[static_cast<std::size_t>(row * picture.width + column)]) continue;
      top = std::min(top, row);
      bottom = std::max(bottom, row + 1);
      left = std::min(left, column);
      right = std::max(right, column + 1);
    }
  }
  if (top >= bottom) return picture;
  Image part(right - left, bottom - top);
  for (int row = top; row < bottom; ++row) {
    for (int column = left; column < right; ++column) {
      for (int c = 0; c < 3; ++c) part.at(row - top, column - left, c) = picture.at(row, column, c);
    }
  }
  return part;
}

std::string convergence_csv(std::span<const ConvergenceRow> rows) {
  std::string text = "sampler,samples,seconds,rms,relative,of_materials\n";
  for (const ConvergenceRow& row : rows) {
    char line[160];
    std::snprintf(line, sizeof line, "%s,%d,%.6g,%.17g,%.17g,%.17g\n", row.sampler.c_str(), row.samples, row.seconds,
                  row.errors.rms, row.errors.relative, row.errors.of_materials);
    text += line;
  }
  return text;
}

plot::Page convergence_page(std::span<const ConvergenceRow> rows, const std::string& title) {
  const bool own = !rows.empty() && !std::isnan(rows.front().errors.of_materials);
  const auto error = own ? &PictureErrors::of_materials : &PictureErrors::rms;
  std::vector<double> samples_all, seconds_all, errors_all, powers;
  for (const ConvergenceRow& row : rows) {
    samples_all.push_back(row.samples);
    seconds_all.push_back(row.seconds);
    errors_all.push_back(row.errors.*error);
    if (std::find(powers.begin(), powers.end(), row.samples) == powers.end()) powers.push_back(row.samples);
  }
  Axis x = roomy("samples a pixel", samples_all);
  x.ticks = powers;
  const Axis y = roomy(own ? "error of the materials' pixels" : "error", errors_all);
  LinePlot samples{.title = "equal samples", .x = x, .y = y};
  LinePlot seconds{.title = "equal time", .x = roomy("processor seconds", seconds_all), .y = y};
  const std::vector<std::string> names = samplers_of(rows);
  for (std::size_t k = 0; k < names.size(); ++k) {
    Line line{.label = names[k], .colour = plot::series_colour(k), .marker = kMarkers[k % std::size(kMarkers)]};
    std::vector<double> time;
    for (const ConvergenceRow& row : rows) {
      if (row.sampler != names[k]) continue;
      line.x.push_back(row.samples);
      time.push_back(row.seconds);
      line.y.push_back(row.errors.*error);
    }
    samples.lines.push_back(line);
    line.x = time;
    seconds.lines.push_back(line);
  }
  return {.title = title, .columns = 2, .panels = {samples, seconds}};
}

}  // namespace sklar::brdf
