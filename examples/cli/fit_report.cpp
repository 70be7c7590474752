#include "examples/cli/fit_report.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "brdf/study/copula_density.hpp"
#include "brdf/study/report_frame.hpp"
#include "brdf/study/table_text.hpp"
#include "copula/archimedean_copula.hpp"
#include "copula/inference/dependence.hpp"
#include "copula/inference/diagnostics.hpp"
#include "copula/rotated.hpp"
#include "examples/cli/text.hpp"

namespace sklar::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr Index kMostPoints = 2000;
constexpr int kNodes = 48;   // a side of the density
constexpr int kSteps = 100;  // of the argument of the Kendall distribution
constexpr int kDigits = 5;

Json rounded(const Column& values) {
  Json array = Json::array();
  for (const double value : values) array.push_back(brdf::to_digits(kDigits, value));
  return array;
}

/// Rows evenly spaced, all where they are few.
Points shown_rows(const Points& u) {
  const Index count = std::min(u.rows(), kMostPoints);
  Points shown(count, u.cols());
  for (Index i = 0; i < count; ++i) shown.row(i) = u.row(i * u.rows() / count);
  return shown;
}

Column kendall_arguments() {
  return Column::LinSpaced(kSteps + 1, 0, 1);
}

/// The share of joint ranks up to each argument.
Column empirical_kendall(const Points& u) {
  const Column ranks = joint_ranks(u);
  return kendall_arguments().unaryExpr([&](double t) { return (ranks <= t).cast<double>().mean(); });
}

/// A copula without its rotations: that of the coordinates of which the reflected ones are 1 - U.
struct Unrotated {
  CopulaPtr copula;
  std::vector<bool> reflected;
};

Unrotated unrotated(CopulaPtr copula) {
  std::vector<bool> reflected(static_cast<std::size_t>(copula->dim()));
  while (const auto* rotated = dynamic_cast<const Rotated*>(copula.get())) {
    for (int k = 0; k < copula->dim(); ++k) {
      const auto place = static_cast<std::size_t>(k);
      reflected[place] = reflected[place] != rotated->reflects(k);
    }
    copula = CopulaPtr(rotated->base());
  }
  return {std::move(copula), std::move(reflected)};
}

Json figures_of(const FitResult& result) {
  Json row = {{"name", result.family},
              {"status", to_text(result.status)},
              {"theta", json_numbers(result.theta)},
              {"se", json_numbers(result.standard_error)},
              {"tau", json_number(result.tau)},
              {"loglik", json_number(result.log_likelihood)},
              {"aic", json_number(result.aic)},
              {"bic", json_number(result.bic)}};
  if (!result.message.empty()) row[result.status == FitStatus::failed ? "error" : "note"] = result.message;
  return row;
}

/// What the plots show of a fitted family; of another kind than Archimedean the density of two columns alone.
void add_curves(Json& row, const CopulaPtr& copula) {
  const Unrotated base = unrotated(copula);
  row["reflected"] = base.reflected;
  const bool pairs_alike = dynamic_cast<const ArchimedeanCopula*>(base.copula.get()) != nullptr;
  row["density"] =
      pairs_alike || copula->dim() == 2 ? Json::parse(brdf::pair_density_json(*copula, kNodes)) : Json(nullptr);
  row["kendall"] = rounded(kendall_distribution(*copula, kendall_arguments()));
}

Json pairs_of(const Points& u) {
  Json pairs = Json::array();
  for (Index a = 0; a < u.cols(); ++a) {
    for (Index b = a + 1; b < u.cols(); ++b) {
      const double tau = kendall_tau(u.col(a), u.col(b));
      pairs.push_back({{"columns", {a, b}}, {"tau", json_number(tau)}});
    }
  }
  return pairs;
}

}  // namespace

void write_fit_report(const std::string& path, const FitReport& report, std::span<const FamilyInfo* const> families,
                      std::span<const FitResult> results) {
  const Points shown = shown_rows(report.u);
  Json data = {{"n", report.u.rows()},
               {"margins", report.margins},
               {"method", to_text(results.front().method)},
               {"columns", report.columns},
               {"pairs", pairs_of(report.u)},
               {"points", Json::array()},
               {"kendall_t", rounded(kendall_arguments())},
               {"kendall", rounded(empirical_kendall(shown))}};
  for (Index k = 0; k < shown.cols(); ++k) data["points"].push_back(rounded(shown.col(k)));
  for (const FitResult& result : results) {
    Json row = figures_of(result);
    if (result.status != FitStatus::failed) {
      const FamilyInfo* family = *std::ranges::find(families, result.family, &FamilyInfo::name);
      add_curves(row, family->make(static_cast<int>(shown.cols()), result.theta));
    }
    data["rows"].push_back(std::move(row));
  }
  write_output(path, brdf::report_file(brdf::ReportKind::fit, "Copula families fitted", data.dump()));
}

}  // namespace sklar::cli
