#pragma once
/// Models of every kind on one material: fitted, judged and kept by the same code.

#include <filesystem>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "brdf/render/image.hpp"
#include "brdf/study/contender.hpp"

namespace sklar::brdf {

/// One model on one material. Figures are NaN where error says why there is no model.
struct ModelRow {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  std::string material = {};
  Provenance provenance = Provenance::unknown;
  std::string kind = {}, model = {};
  double budget = 0;         ///< bytes, 0 for a model of one size
  double bytes = kNone;      ///< ContenderFit::bytes
  double fit_s = kNone;      ///< wall clock, all threads
  double eval_ns = kNone;    ///< evaluation_ns
  double log1p_mae = kNone;  ///< this and the next three: CellErrors, mean over channels
  double logrel_mae = kNone;
  double cuberoot_rms = kNone;
  double rel_l2 = kNone;
  double sphere_psnr_linear_db = kNone;  ///< mean over channels
  double psnr_gamma_db = kNone;          ///< this and the next two: ImageErrors of the rendered sphere
  double ssim = kNone;
  double delta_e_2000 = kNone;
  double sampling_efficiency = kNone;  ///< mean over kEfficiencyAngles of 1 / (1 + weight_deviation^2)
  double reciprocity_error = kNone;    ///< reciprocity_error below
  double albedo_max = kNone;           ///< of albedo_angles() and the channels
  std::string note = {};               ///< what the fit has to say
  std::string error = {};              ///< why there is no model
  std::string inputs = {};             ///< what it was made from, inputs_of_job; in the file of the row alone
};

/// Mean of |f(wo, wi) - f(wi, wo)| over the mean of |f|, over 4096 seeded random pairs and the channels; 0 where both
/// are 0.
[[nodiscard]] double reciprocity_error(const Brdf& brdf);

struct ModelComparison {
  std::vector<ModelRow> rows;       ///< in the order of the contenders
  Image reference;                  ///< the sphere of the table
  std::vector<Image> spheres;       ///< those of the rows; empty where there is no model
  std::string reference_curves;     ///< curves_json of the table
  std::vector<std::string> curves;  ///< and of the rows; empty where there is no model
};

/// Fits and judges each contender and keeps what is finished in FOLDER/MATERIAL, as ModelJobs: what is there already,
/// made from the same inputs, is read instead, so that an interrupted comparison goes on where it was.
/// @param progress called with what is being done, for a person to read.
/// @throws FileError for a folder that cannot be written or a row in it that is damaged, naming it.
[[nodiscard]] ModelComparison compare_models(const ContenderData& data, std::span<const Contender> contenders,
                                             const std::filesystem::path& folder,
                                             const std::function<void(const std::string&)>& progress = {});

/// The rows as one JSON document with the machine; as CSV; as a Markdown table. The first two have rank_MEASURE for
/// each measure of error: the rank of the row among those of its material that have a model, 1 is best, equals share
/// the mean of theirs; "nan" without a model.
[[nodiscard]] std::string to_json(std::span<const ModelRow> rows);
[[nodiscard]] std::string to_csv(std::span<const ModelRow> rows);
[[nodiscard]] std::string to_markdown(std::span<const ModelRow> rows);

/// A row a model and budget: means over the materials that have it, and its mean rank among all models by each measure
/// of error, 1 is best; by the mean of these ranks.
[[nodiscard]] std::string summary_markdown(std::span<const ModelRow> rows);

/// Reference, the refined models by budget, the best analytic and the best basis model by log1p_mae, each with its
/// difference: as write_sphere_figure. @return the path FOLDER/models_MATERIAL.png.
std::filesystem::path write_model_sheet(const ModelComparison& comparison, const std::filesystem::path& folder);

}  // namespace sklar::brdf
