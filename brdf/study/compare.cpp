#include "brdf/study/compare.hpp"

#include <chrono>
#include <cmath>
#include <numbers>

#include "copula/random.hpp"
#include "copula/study/timing.hpp"

namespace sklar::brdf {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

Directions uniform_hemisphere(Rng& rng, Eigen::Index count) {
  Directions w(count, 3);
  for (Eigen::Index row = 0; row < count; ++row) {
    const double z = uniform(rng), phi = 2 * std::numbers::pi * uniform(rng), radius = std::sqrt(1 - z * z);
    w.row(row) << radius * std::cos(phi), radius * std::sin(phi), z;
  }
  return w;
}

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
  row.mode = "refined";
  return fit_refined(table, refined).brdf;
}

// Everything but the sphere, which all models share.
View fit_and_view(CompareRow& row, const MeasuredTable& table, const FamilyInfo& family,
                  const FamilyFitOptions& options) {
  const auto start = Clock::now();
  const BrdfPtr brdf = fit_family(row, table, family, options);
  row.fit_s = seconds_since(start);
  row.bytes = brdf->bytes();
  row.eval_ns = evaluation_ns(*brdf);
  View result = view(family.title, *brdf, table);
  const CellErrors errors = cell_errors(table, result.cells);
  row.log1p_mae = errors.log1p_mae.mean();
  row.logrel_mae = errors.logrel_mae.mean();
  row.cuberoot_rms = errors.cuberoot_rms.mean();
  row.rel_l2 = errors.rel_l2.mean();
  row.albedo_max = result.albedo.albedo.maxCoeff();
  return result;
}

constexpr Eigen::Index kBatch = 4096;

struct DirectionPairs {
  DirectionPairs() : DirectionPairs(Rng(1)) {}
  explicit DirectionPairs(Rng rng) : wo(uniform_hemisphere(rng, kBatch)), wi(uniform_hemisphere(rng, kBatch)) {}

  Directions wo, wi;
};

/// @param batch gives a sum of its values, NaN where it failed.
template <class Batch>
double ns_of_one(const Batch& batch) {
  double sum = 0;
  const double seconds = seconds_per_call([&] { sum = batch(); });
  return std::isnan(sum) ? std::numeric_limits<double>::quiet_NaN() : seconds / kBatch * 1e9;
}

}  // namespace

double evaluation_ns(const Brdf& brdf) {
  const DirectionPairs pairs;
  return ns_of_one([&] { return brdf.eval(pairs.wo, pairs.wi).sum(); });
}

double single_evaluation_ns(const Brdf& brdf) {
  const DirectionPairs pairs;
  return ns_of_one([&] {
    Rgb sum = Rgb::Zero();
    for (Eigen::Index i = 0; i < pairs.wo.rows(); ++i) {
      sum += brdf.eval(Vec3(pairs.wo.row(i).matrix()), Vec3(pairs.wi.row(i).matrix()));
    }
    return sum.sum();
  });
}

Comparison compare_families(std::shared_ptr<const MeasuredTable> table, std::span<const FamilyInfo* const> families,
                            const FamilyFitOptions& options, const std::filesystem::path& folder,
                            const std::function<void(const std::string&)>& progress) {
  const auto say = [&](const std::string& what) {
    if (progress) progress(table->name + ": " + what);
  };
  say("reference");
  const View reference = view(table);
  std::vector<View> models;
  std::vector<const CellValues*> tables = {&reference.cells};
  Comparison result;
  for (const FamilyInfo* family : families) {
    say(family->name);
    CompareRow row{.material = table->name, .provenance = table->provenance, .family = family->name};
    try {
      models.push_back(fit_and_view(row, *table, *family, options));
    } catch (const std::runtime_error& error) {
      row.error = error.what();
    }
    result.rows.push_back(std::move(row));
  }
  say("sphere");
  for (const View& model : models) tables.push_back(&model.cells);
  const std::vector<SpherePixels> pixels = sphere_pixels(tables);
  std::size_t next = 1;
  for (CompareRow& row : result.rows) {
    if (row.error.empty()) row.sphere_psnr_linear_db = sphere_psnr_linear_db(pixels[0], pixels[next++]).mean();
  }
  say("figures");
  const std::string title = table->name + " (" + to_text(table->provenance) + ")";
  result.figures = write_figures(folder, table->name, title, reference, models);
  return result;
}

}  // namespace sklar::brdf
