#pragma once
/// One model on one material as a job: fitted, judged and kept in files, so that it is done once.

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "brdf/study/figures.hpp"
#include "brdf/study/model_comparison.hpp"

namespace sklar::brdf {

/// ModelRow::inputs of a job.
[[nodiscard]] std::string inputs_of_job(const ContenderData& data, const Contender& contender);

/// What a job leaves in the folder of its material, NAME being that of the contender.
struct JobFiles {
  std::filesystem::path row;     ///< NAME.json, written last: where it is, the job is done
  std::filesystem::path sphere;  ///< NAME.exr; this and the next two only where there is a model
  std::filesystem::path curves;  ///< NAME.curves.json, curves_json
  std::filesystem::path model;   ///< NAME.model.json, as write_brdf; of models that have this form
};
/// @param place the folder of the material.
[[nodiscard]] JobFiles job_files(const std::filesystem::path& place, const Contender& contender);

/// The row of a finished job. Empty where there is none, or one made from other inputs.
/// @param inputs as inputs_of_job. @throws FileError for a damaged row, naming it.
[[nodiscard]] std::optional<ModelRow> finished_row(const JobFiles& files, const std::string& inputs);

/// A row still without figures.
[[nodiscard]] ModelRow empty_row(const std::string& material, Provenance provenance, const Contender& contender,
                                 std::string inputs);

/// Finishes a job that has failed: nothing but the row is left of it. @throws FileError
void write_failure(const JobFiles& files, const ModelRow& row);

/// The jobs of one material.
class ModelJobs {
 public:
  /// @param place folder of the material, made when something is written into it
  ModelJobs(ContenderData data, std::filesystem::path place);
  ~ModelJobs();
  ModelJobs(const ModelJobs&) = delete;
  ModelJobs& operator=(const ModelJobs&) = delete;

  /// Fits, judges and keeps. A fit that throws is a row with its error. @throws FileError for what cannot be written.
  ModelRow run(const Contender& contender);

  /// Sphere and curves of the table, reference.exr and reference.curves.json. The first run that has a model writes
  /// them, too.
  void write_reference();
  [[nodiscard]] std::filesystem::path reference_sphere() const { return place_ / "reference.exr"; }
  [[nodiscard]] std::filesystem::path reference_curves() const { return place_ / "reference.curves.json"; }

 private:
  class Reference;
  struct Fitted;

  /// Empty where the row says why there is no model.
  std::optional<Fitted> fit_and_judge(const Contender& contender, ModelRow& row);
  void judge(const Brdf& brdf, const View& model, ModelRow& row);

  ContenderData data_;
  std::filesystem::path place_;
  std::unique_ptr<Reference> reference_;
  bool reference_written_ = false;
};

}  // namespace sklar::brdf
