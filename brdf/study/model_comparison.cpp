#include "brdf/study/model_comparison.hpp"

#include <cmath>
#include <numbers>
#include <optional>

#include "brdf/geometry/frame.hpp"
#include "brdf/study/figures.hpp"
#include "brdf/study/model_job.hpp"
#include "copula/error.hpp"
#include "copula/file.hpp"
#include "copula/random.hpp"

namespace sklar::brdf {

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
  ModelJobs jobs(data, place);
  ModelComparison result;
  for (std::size_t n = 0; n < contenders.size(); ++n) {
    const Contender& contender = contenders[n];
    if (progress) {
      progress(data.table->name + ": " + contender.name() + " (" + std::to_string(n + 1) + " of " +
               std::to_string(contenders.size()) + ")");
    }
    const JobFiles files = job_files(place, contender);
    const auto finished = finished_row(files, inputs_of_job(data, contender));
    const ModelRow& row = result.rows.emplace_back(finished ? *finished : jobs.run(contender));
    const bool fitted = row.error.empty();
    result.spheres.push_back(fitted ? read_exr(files.sphere) : Image());
    result.curves.push_back(fitted ? read_file(files.curves) : "");
  }
  if (!std::filesystem::exists(jobs.reference_curves())) jobs.write_reference();
  result.reference = read_exr(jobs.reference_sphere());
  result.reference_curves = read_file(jobs.reference_curves());
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
