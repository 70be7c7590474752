#include "brdf/study/model_job.hpp"

#include <array>
#include <numbers>
#include <utility>

#include "brdf/data/table_brdf.hpp"
#include "brdf/study/curves.hpp"
#include "brdf/study/efficiency.hpp"
#include "brdf/study/evaluation_time.hpp"
#include "brdf/study/figures.hpp"
#include "brdf/study/image_metrics.hpp"
#include "brdf/study/model_row.hpp"
#include "copula/file.hpp"
#include "copula/study/timing.hpp"

namespace sklar::brdf {

/// The table's view and pixels, computed when they are needed first.
class ModelJobs::Reference {
 public:
  explicit Reference(std::shared_ptr<const MeasuredTable> table) : table_(std::move(table)) {}

  [[nodiscard]] const View& view() {
    if (!view_) view_ = brdf::view(table_);
    return *view_;
  }
  [[nodiscard]] const SpherePixels& pixels() {
    if (pixels_.rows() == 0) pixels_ = pixels_of(view().cells);
    return pixels_;
  }
  static SpherePixels pixels_of(const CellValues& cells) {
    const std::array<const CellValues*, 1> one{&cells};
    return sphere_pixels(one).front();
  }

 private:
  std::shared_ptr<const MeasuredTable> table_;
  std::optional<View> view_{};
  SpherePixels pixels_{};
};

struct ModelJobs::Fitted {
  ContenderFit fit;
  View view;
};

namespace {

double sampling_efficiency_of(const Brdf& brdf) {
  double sum = 0;
  for (const double degrees : kEfficiencyAngles) {
    const double deviation = weight_deviation(brdf, degrees * std::numbers::pi / 180);
    sum += 1 / (1 + deviation * deviation);
  }
  return sum / kEfficiencyAngles.size();
}

}  // namespace

std::string inputs_of_job(const ContenderData& data, const Contender& contender) {
  return contender.learns ? data.inputs + "; others: " + data.inputs_of_others : data.inputs;
}

JobFiles job_files(const std::filesystem::path& place, const Contender& contender) {
  const auto file = [&](const char* ending) { return place / (contender.name() + ending); };
  return {file(".json"), file(".exr"), file(".curves.json"), file(".model.json")};
}

std::optional<ModelRow> finished_row(const JobFiles& files, const std::string& inputs) {
  if (!std::filesystem::exists(files.row)) return std::nullopt;
  ModelRow row = model_row_from_json(read_file(files.row), files.row.string());
  if (row.inputs != inputs) return std::nullopt;
  return row;
}

ModelRow empty_row(const std::string& material, Provenance provenance, const Contender& contender, std::string inputs) {
  return {.material = material,
          .provenance = provenance,
          .kind = contender.kind,
          .model = contender.model,
          .budget = contender.max_bytes,
          .inputs = std::move(inputs)};
}

void write_failure(const JobFiles& files, const ModelRow& row) {
  for (const auto& file : {files.sphere, files.curves, files.model}) std::filesystem::remove(file);
  write_file(files.row, to_json(row));
}

ModelJobs::ModelJobs(ContenderData data, std::filesystem::path place)
    : data_(std::move(data)), place_(std::move(place)), reference_(std::make_unique<Reference>(data_.table)) {}

ModelJobs::~ModelJobs() = default;

ModelRow ModelJobs::run(const Contender& contender) {
  make_folder(place_);
  const JobFiles files = job_files(place_, contender);
  std::filesystem::remove(files.row);
  ModelRow row = empty_row(data_.table->name, data_.table->provenance, contender, inputs_of_job(data_, contender));
  const std::optional<Fitted> fitted = fit_and_judge(contender, row);
  if (!fitted) {
    write_failure(files, row);
    return row;
  }
  if (!reference_written_) write_reference();
  write_exr(files.sphere, fitted->view.sphere);
  write_file(files.curves, curves_json(*fitted->fit.brdf, fitted->view));
  if (fitted->fit.model) {
    write_brdf(files.model, {.material = row.material, .provenance = row.provenance, .model = *fitted->fit.model});
  }
  write_file(files.row, to_json(row));
  return row;
}

std::optional<ModelJobs::Fitted> ModelJobs::fit_and_judge(const Contender& contender, ModelRow& row) {
  const ModelRow empty = row;
  const auto fail = [&](const std::exception& error) {
    row = empty;
    row.error = error.what();
  };
  try {
    const Stopwatch stopwatch;
    ContenderFit fit = contender.fit(data_);
    row.fit_s = stopwatch.seconds();
    row.bytes = static_cast<double>(fit.bytes);
    row.note = fit.note;
    View model = view(row.model, *fit.brdf, *data_.table);
    judge(*fit.brdf, model, row);
    return Fitted{std::move(fit), std::move(model)};
  } catch (const std::runtime_error& error) {
    fail(error);
  } catch (const std::logic_error& error) {
    fail(error);
  }
  return std::nullopt;
}

void ModelJobs::judge(const Brdf& brdf, const View& model, ModelRow& row) {
  row.eval_ns = evaluation_ns(brdf);
  const CellErrors errors = cell_errors(*data_.table, model.cells);
  row.log1p_mae = errors.log1p_mae.mean();
  row.logrel_mae = errors.logrel_mae.mean();
  row.cuberoot_rms = errors.cuberoot_rms.mean();
  row.rel_l2 = errors.rel_l2.mean();
  row.sphere_psnr_linear_db = sphere_psnr_linear_db(reference_->pixels(), Reference::pixels_of(model.cells)).mean();
  const Image& target = reference_->view().sphere;
  const ImageErrors image = image_errors(target, model.sphere, display_exposure(target));
  row.psnr_gamma_db = image.psnr_gamma_db;
  row.ssim = image.ssim;
  row.delta_e_2000 = image.delta_e_2000;
  row.sampling_efficiency = sampling_efficiency_of(brdf);
  row.reciprocity_error = reciprocity_error(brdf);
  row.albedo_max = model.albedo.albedo.maxCoeff();
}

void ModelJobs::write_reference() {
  make_folder(place_);
  write_exr(reference_sphere(), reference_->view().sphere);
  write_file(reference_curves(), curves_json(TableBrdf(data_.table), reference_->view()));
  reference_written_ = true;
}

}  // namespace sklar::brdf
