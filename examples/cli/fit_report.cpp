#include "examples/cli/fit_report.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "brdf/study/copula_density.hpp"
#include "brdf/study/report_frame.hpp"
#include "brdf/study/table_text.hpp"
#include "copula/archimedean_copula.hpp"
#include "copula/inference/dependence.hpp"
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

/// The share of rows i with V_i <= t, V_i the share of the other rows that are less in every coordinate. Genest and
/// Rivest (1993), J. Amer. Statist. Assoc. 88, 1034. O(n^2 d).
Column empirical_kendall(const Points& u, const Column& t) {
  std::vector<double> below(static_cast<std::size_t>(u.rows()));
  for (Index i = 0; i < u.rows(); ++i) {
    Index count = 0;
    for (Index j = 0; j < u.rows(); ++j) count += (u.row(j) < u.row(i)).all();
    below[static_cast<std::size_t>(i)] = static_cast<double>(count) / static_cast<double>(u.rows() - 1);
  }
  std::ranges::sort(below);
  Column shares(t.size());
  for (Index n = 0; n < t.size(); ++n) {
    const auto count = std::ranges::upper_bound(below, t(n)) - below.begin();
    shares(n) = static_cast<double>(count) / static_cast<double>(below.size());
  }
  return shares;
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

/// The data as the families need them: first as they are, then reflected in the coordinates of each rotation.
class Reflections {
 public:
  Reflections(const Points& u, const std::vector<std::string>& columns) : u_(u), columns_(columns) {
    (void)place(std::vector<bool>(columns.size()));
  }

  [[nodiscard]] std::size_t place(const std::vector<bool>& reflected) {
    const auto known = std::ranges::find(known_, reflected);
    const auto place = static_cast<std::size_t>(known - known_.begin());
    if (known != known_.end()) return place;
    known_.push_back(reflected);
    std::string names;
    Points data = u_;
    for (std::size_t k = 0; k < reflected.size(); ++k) {
      if (!reflected[k]) continue;
      names += (names.empty() ? "" : ", ") + columns_[k];
      const auto column = static_cast<Index>(k);
      data.col(column) = 1 - data.col(column);
    }
    json_.push_back({{"label", names.empty() ? "data" : "data with 1 − u of " + names},
                     {"kendall", rounded(empirical_kendall(data, kendall_arguments()))}});
    return place;
  }

  [[nodiscard]] const Json& json() const { return json_; }

 private:
  const Points& u_;
  const std::vector<std::string>& columns_;
  std::vector<std::vector<bool>> known_;
  Json json_ = Json::array();
};

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
void add_curves(Json& row, const Copula& copula, const Unrotated& base, Reflections& reflections) {
  const auto* archimedean = dynamic_cast<const ArchimedeanCopula*>(base.copula.get());
  row["reflected"] = base.reflected;
  row["reflection"] = reflections.place(base.reflected);
  row["density"] = nullptr;
  row["kendall"] = nullptr;
  if (archimedean != nullptr || copula.dim() == 2) {
    row["density"] = Json::parse(brdf::pair_density_json(copula, kNodes));
  }
  if (archimedean != nullptr) row["kendall"] = rounded(archimedean->kendall_cdf(kendall_arguments()));
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
               {"kendall_t", rounded(kendall_arguments())}};
  for (Index k = 0; k < shown.cols(); ++k) data["points"].push_back(rounded(shown.col(k)));
  Reflections reflections(shown, report.columns);
  for (const FitResult& result : results) {
    Json row = figures_of(result);
    if (result.status != FitStatus::failed) {
      const FamilyInfo* family = *std::ranges::find(families, result.family, &FamilyInfo::name);
      const CopulaPtr copula = family->make(static_cast<int>(shown.cols()), result.theta);
      add_curves(row, *copula, unrotated(copula), reflections);
    }
    data["rows"].push_back(std::move(row));
  }
  data["reflections"] = reflections.json();
  write_output(path, brdf::report_file(brdf::ReportKind::fit, "Copula families fitted", data.dump()));
}

}  // namespace sklar::cli
