#include "brdf/study/compare.hpp"

#include <set>

#include "brdf/data/table_brdf.hpp"
#include "brdf/study/curves.hpp"
#include "brdf/study/evaluation_time.hpp"
#include "copula/study/timing.hpp"

namespace sklar::brdf {
namespace {

BrdfPtr fit_family(CompareRow& row, const MeasuredTable& table, const FamilyInfo& family,
                   const FamilyFitOptions& options) {
  if (const auto* paper = std::get_if<PaperFitOptions>(&options)) {
    const PaperFit fit = fit_paper(table, family, *paper);
    for (std::size_t channel = 0; channel < 3; ++channel) {
      for (const FitResult& slice : fit.fits[channel]) row.theta[channel].push_back(slice.theta);
    }
    return fit.brdf;
  }
  RefinedFitOptions refined = std::get<RefinedFitOptions>(options);
  refined.families = {family};
  return fit_refined(table, refined).brdf;
}

// Everything but the sphere, which all models share.
View fit_and_view(CompareRow& row, std::string& curves, const MeasuredTable& table, const FamilyInfo& family,
                  const FamilyFitOptions& options) {
  const Stopwatch stopwatch;
  const BrdfPtr brdf = fit_family(row, table, family, options);
  row.fit_s = stopwatch.seconds();
  row.bytes = brdf->bytes();
  row.eval_ns = evaluation_ns(*brdf);
  View result = view(family.title, *brdf, table);
  const CellErrors errors = cell_errors(table, result.cells);
  row.log1p_mae = errors.log1p_mae.mean();
  row.logrel_mae = errors.logrel_mae.mean();
  row.cuberoot_rms = errors.cuberoot_rms.mean();
  row.rel_l2 = errors.rel_l2.mean();
  row.albedo_max = result.albedo.albedo.maxCoeff();
  curves = curves_json(*brdf, result);
  return result;
}

}  // namespace

Comparison compare_families(std::shared_ptr<const MeasuredTable> table, std::span<const FamilyInfo* const> families,
                            std::span<const FamilyFitOptions> modes, const std::filesystem::path& folder,
                            const std::function<void(const std::string&)>& progress) {
  const auto say = [&](const std::string& what) {
    if (progress) progress(table->name + ": " + what);
  };
  say("reference");
  const View reference = view(table);
  std::vector<View> models;
  std::vector<const CellValues*> tables = {&reference.cells};
  Comparison result;
  result.reference_curves = curves_json(TableBrdf(table), reference);
  for (const FamilyFitOptions& mode : modes) {
    for (const FamilyInfo* family : families) {
      CompareRow row{.material = table->name,
                     .provenance = table->provenance,
                     .family = family->name,
                     .mode = std::holds_alternative<PaperFitOptions>(mode) ? "paper" : "refined"};
      say(row.mode + ", " + family->name);
      std::string& curves = result.curves.emplace_back();
      try {
        models.push_back(fit_and_view(row, curves, *table, *family, mode));
        if (modes.size() > 1) models.back().name = row.mode + ", " + models.back().name;
      } catch (const std::runtime_error& error) {
        row.error = error.what();
      }
      result.rows.push_back(std::move(row));
    }
  }
  say("sphere");
  for (const View& model : models) tables.push_back(&model.cells);
  const std::vector<SpherePixels> pixels = sphere_pixels(tables);
  std::size_t next = 1;
  for (CompareRow& row : result.rows) {
    if (row.error.empty()) row.sphere_psnr_linear_db = sphere_psnr_linear_db(pixels[0], pixels[next++]).mean();
  }
  next = 0;
  for (const CompareRow& row : result.rows) {
    result.spheres.push_back(row.error.empty() ? models[next++].sphere : Image());
  }
  result.reference = reference.sphere;
  say("figures");
  const std::string title = table->name + " (" + to_text(table->provenance) + ")";
  result.figures = write_figures(folder, table->name, title, reference, models);
  return result;
}

std::vector<std::filesystem::path> write_sphere_sheets(std::span<const Comparison> materials,
                                                       const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> paths;
  if (materials.empty()) return paths;
  for (std::size_t model = 0; model < materials.front().rows.size(); ++model) {
    const CompareRow& first = materials.front().rows[model];
    std::vector<SpherePair> columns;
    std::set<std::string> provenances;
    for (const Comparison& material : materials) {
      const CompareRow& row = material.rows[model];
      if (!row.error.empty()) continue;
      provenances.insert(to_text(row.provenance));
      columns.push_back({.label = row.material, .reference = &material.reference, .model = &material.spheres[model]});
    }
    if (columns.empty()) continue;
    paths.push_back(folder / ("spheres_" + first.mode + "_" + first.family + ".png"));
    std::string title = first.mode + ", " + first.family;
    for (const std::string& provenance : provenances) title += ", " + provenance;
    write_sphere_figure(paths.back(), title, columns);
  }
  return paths;
}

}  // namespace sklar::brdf
