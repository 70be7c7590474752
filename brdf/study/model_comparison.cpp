#include "brdf/study/model_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "brdf/data/table_brdf.hpp"
#include "brdf/geometry/frame.hpp"
#include "brdf/study/curves.hpp"
#include "brdf/study/efficiency.hpp"
#include "brdf/study/evaluation_time.hpp"
#include "brdf/study/figures.hpp"
#include "brdf/study/image_metrics.hpp"
#include "brdf/study/model_row.hpp"
#include "copula/error.hpp"
#include "copula/file.hpp"
#include "copula/random.hpp"
#include "copula/study/timing.hpp"

namespace sklar::brdf {
namespace {

/// The reference, computed when the first row needs it.
class Reference {
 public:
  explicit Reference(std::shared_ptr<const MeasuredTable> table) : table_(std::move(table)) {}

  [[nodiscard]] const MeasuredTable& table() const { return *table_; }
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

double sampling_efficiency_of(const Brdf& brdf) {
  double sum = 0;
  for (const double degrees : kEfficiencyAngles) {
    const double deviation = weight_deviation(brdf, degrees * std::numbers::pi / 180);
    sum += 1 / (1 + deviation * deviation);
  }
  return sum / kEfficiencyAngles.size();
}

/// What is kept of a model beside its row.
struct Kept {
  Image sphere{};
  std::string curves{};
};

/// Empty where the file is missing.
std::string kept_text(const std::filesystem::path& path) {
  return std::filesystem::exists(path) ? read_file(path) : "";
}

void judge(ModelRow& row, const Brdf& brdf, Reference& reference, Kept& kept) {
  row.eval_ns = evaluation_ns(brdf);
  const View model = view(row.model, brdf, reference.table());
  const CellErrors errors = cell_errors(reference.table(), model.cells);
  row.log1p_mae = errors.log1p_mae.mean();
  row.logrel_mae = errors.logrel_mae.mean();
  row.cuberoot_rms = errors.cuberoot_rms.mean();
  row.rel_l2 = errors.rel_l2.mean();
  row.sphere_psnr_linear_db = sphere_psnr_linear_db(reference.pixels(), Reference::pixels_of(model.cells)).mean();
  const Image& target = reference.view().sphere;
  const ImageErrors image = image_errors(target, model.sphere, display_exposure(target));
  row.psnr_gamma_db = image.psnr_gamma_db;
  row.ssim = image.ssim;
  row.delta_e_2000 = image.delta_e_2000;
  row.sampling_efficiency = sampling_efficiency_of(brdf);
  row.reciprocity_error = reciprocity_error(brdf);
  row.albedo_max = model.albedo.albedo.maxCoeff();
  kept = {model.sphere, curves_json(brdf, model)};
}

ModelRow fit_and_judge(const ContenderData& data, const Contender& contender, Reference& reference, Kept& kept) {
  ModelRow row{.material = data.table->name,
               .provenance = data.table->provenance,
               .kind = contender.kind,
               .model = contender.model,
               .budget = contender.max_bytes};
  const auto fail = [&](const std::exception& error) {
    kept = {};
    row.error = error.what();
  };
  try {
    const Stopwatch stopwatch;
    const ContenderFit fit = contender.fit(data);
    row.fit_s = stopwatch.seconds();
    row.bytes = static_cast<double>(fit.bytes);
    row.note = fit.note;
    judge(row, *fit.brdf, reference, kept);
  } catch (const std::runtime_error& error) {
    fail(error);
  } catch (const std::logic_error& error) {
    fail(error);
  }
  return row;
}

}  // namespace

double reciprocity_error(const Brdf& brdf) {
  constexpr int kPairs = 4096;
  Rng rng(1);
  const auto direction = [&] {
    const double cosine = uniform(rng);
    return spherical_direction(std::acos(cosine), 2 * std::numbers::pi * uniform(rng));
  };
  double difference = 0, total = 0;
  for (int n = 0; n < kPairs; ++n) {
    const Vec3 wo = direction(), wi = direction();
    const Rgb one = brdf.eval(wo, wi), other = brdf.eval(wi, wo);
    difference += (one - other).abs().sum();
    total += (one.abs() + other.abs()).sum() / 2;
  }
  return total > 0 ? difference / total : 0;
}

ModelComparison compare_models(const ContenderData& data, std::span<const Contender> contenders,
                               const std::filesystem::path& folder,
                               const std::function<void(const std::string&)>& progress) {
  const std::filesystem::path place = folder / data.table->name;
  make_folder(place);
  Reference reference(data.table);
  ModelComparison result;
  for (std::size_t n = 0; n < contenders.size(); ++n) {
    const Contender& contender = contenders[n];
    if (progress) {
      progress(data.table->name + ": " + contender.name() + " (" + std::to_string(n + 1) + " of " +
               std::to_string(contenders.size()) + ")");
    }
    const std::filesystem::path row_file = place / (contender.name() + ".json");
    const std::filesystem::path sphere_file = place / (contender.name() + ".exr");
    const std::filesystem::path curves_file = place / (contender.name() + ".curves.json");
    Kept kept;
    if (std::filesystem::exists(row_file)) {
      result.rows.push_back(model_row_from_json(read_file(row_file), row_file.string()));
      if (result.rows.back().error.empty()) kept = {read_exr(sphere_file), kept_text(curves_file)};
    } else {
      result.rows.push_back(fit_and_judge(data, contender, reference, kept));
      if (result.rows.back().error.empty()) {
        write_exr(sphere_file, kept.sphere);
        write_file(curves_file, kept.curves);
      }
      write_file(row_file, to_json(result.rows.back()));  // the last, so that a row there is a row finished
    }
    result.spheres.push_back(std::move(kept.sphere));
    result.curves.push_back(std::move(kept.curves));
  }
  const std::filesystem::path reference_file = place / "reference.exr";
  const std::filesystem::path reference_curves_file = place / "reference.curves.json";
  if (!std::filesystem::exists(reference_file)) write_exr(reference_file, reference.view().sphere);
  if (!std::filesystem::exists(reference_curves_file)) {
    write_file(reference_curves_file, curves_json(TableBrdf(data.table), reference.view()));
  }
  result.reference = read_exr(reference_file);
  result.reference_curves = read_file(reference_curves_file);
  return result;
}

std::filesystem::path write_model_sheet(const ModelComparison& comparison, const std::filesystem::path& folder) {
  std::vector<SpherePair> columns;
  const auto add = [&](std::size_t n) {
    const ModelRow& row = comparison.rows[n];
    const std::string budget = row.budget > 0 ? ", " + sklar::to_text(row.budget) + " bytes" : "";
    columns.push_back(
        {.label = row.model + budget, .reference = &comparison.reference, .model = &comparison.spheres[n]});
  };
  const auto best = [&](const char* kind) {
    std::optional<std::size_t> least;
    for (std::size_t n = 0; n < comparison.rows.size(); ++n) {
      const ModelRow& row = comparison.rows[n];
      if (row.kind != kind || row.model == "table" || !row.error.empty()) continue;
      if (!least || row.log1p_mae < comparison.rows[*least].log1p_mae) least = n;
    }
    return least;
  };
  for (std::size_t n = 0; n < comparison.rows.size(); ++n) {
    if (comparison.rows[n].model == "refined" && comparison.rows[n].error.empty()) add(n);
  }
  for (const char* kind : {"analytic", "basis"}) {
    if (const auto n = best(kind)) add(*n);
  }
  if (columns.empty()) return {};
  const ModelRow& first = comparison.rows.front();
  const std::filesystem::path path = folder / ("models_" + first.material + ".png");
  write_sphere_figure(path, first.material + " (" + to_text(first.provenance) + ")", columns);
  return path;
}

}  // namespace sklar::brdf
