#pragma once
/// How fast path traced pictures converge with the way in which materials draw directions.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "brdf/progress.hpp"
#include "brdf/render/image.hpp"
#include "brdf/render/scene.hpp"
#include "copula/plot/plot.hpp"

namespace sklar::brdf {

/// A scene with its materials drawn in one way.
struct Drawing {
  std::string name;
  Scene scene;
};

/// The scene with the materials drawn by `conditional` (SampledBrdf), `cosine` (the hemisphere), and `ggx` (ggx_sampler
/// of each). Other objects keep their own samplers. @param materials as objects of the scene hold them, isotropic.
/// @throws std::invalid_argument for an anisotropic one.
[[nodiscard]] std::vector<Drawing> drawings(const Scene& scene, std::span<const BrdfPtr> materials);

/// Two independent pictures of a scene: with both, errors are estimated without the error of either.
struct ReferencePair {
  Image first = {}, second = {};
  std::vector<bool> of_materials = {};  ///< see pixels_of; empty: not asked

  /// The better estimate of the picture.
  [[nodiscard]] Image mean() const;
};

/// Without of_materials. @param samples of each of both pictures, from the seeds seed and seed + 1.
/// @throws as render_paths.
[[nodiscard]] ReferencePair render_references(const Scene& scene, int samples, std::uint64_t seed,
                                              const Progress& progress = {});

/// ReferencePair::of_materials: whether all rays of a pixel meet objects of these materials, row by row.
[[nodiscard]] std::vector<bool> pixels_of(Scene scene, std::span<const BrdfPtr> materials);

/// Errors of a picture P against the expectation T of the references A and B, over linear RGB. Each is the root of a
/// mean of (P - A)(P - B), whose expectation is that of (P - T)^2 where the three are independent; 0 where it is
/// negative.
struct PictureErrors {
  double rms;       ///< over the mean of T
  double relative;  ///< of each pixel's difference over the mean of its channels in T and a hundredth of the mean of T
  double of_materials;  ///< rms over the pixels of the materials and their mean; NaN without any
};

/// @throws std::invalid_argument for pictures of different sizes.
[[nodiscard]] PictureErrors picture_errors(const Image& picture, const ReferencePair& reference);

/// The error of one picture.
struct ConvergenceRow {
  std::string sampler;  ///< Drawing::name
  int samples;          ///< paths a pixel
  double seconds;       ///< of processor time, all threads together; making samplers is not in it
  PictureErrors errors;
};

/// A picture and its error.
struct MeasuredPicture {
  ConvergenceRow row;
  Image image;
};

/// Renders once. @throws as render_paths.
[[nodiscard]] MeasuredPicture measure_picture(const Drawing& drawing, const ReferencePair& reference, int samples,
                                              std::uint64_t seed, const Progress& progress = {});

/// The error of a sampler after so many seconds: logarithms joined by straight lines between its rows. NaN beyond them.
[[nodiscard]] double error_at(std::span<const ConvergenceRow> rows, const std::string& sampler,
                              double PictureErrors::*error, double seconds);

/// The longest time that every sampler of the rows reached.
[[nodiscard]] double common_seconds(std::span<const ConvergenceRow> rows);

/// The part of a picture around the pixels of the materials; all of it where there are none.
[[nodiscard]] Image around_materials(const Image& picture, const ReferencePair& reference);

/// sampler,samples,seconds,rms,relative,of_materials
[[nodiscard]] std::string convergence_csv(std::span<const ConvergenceRow> rows);

/// The error of the pixels of the materials (of all pixels where there are none) against samples and against seconds.
[[nodiscard]] plot::Page convergence_page(std::span<const ConvergenceRow> rows, const std::string& title);

}  // namespace sklar::brdf
