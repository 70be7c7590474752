#include "brdf/study/model_row.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "brdf/study/results.hpp"
#include "brdf/study/table_text.hpp"
#include "copula/error.hpp"
#include "copula/json_fields.hpp"

namespace sklar::brdf {
namespace {

using json::Json;

enum class Better { lower, higher, neither };  ///< neither has no rank

struct Figure {
  const char* name;
  const char* heading;
  const char* format;  // of the Markdown table
  double ModelRow::*value;
  Better better;
};

constexpr std::array kFigures = {
    Figure{"bytes", "bytes", "%.0f", &ModelRow::bytes, Better::neither},
    Figure{"fit_s", "fit s", "%.1f", &ModelRow::fit_s, Better::neither},
    Figure{"eval_ns", "ns", "%.0f", &ModelRow::eval_ns, Better::neither},
    Figure{"log1p_mae", "log1p_mae", "%.4f", &ModelRow::log1p_mae, Better::lower},
    Figure{"logrel_mae", "logrel_mae", "%.4f", &ModelRow::logrel_mae, Better::lower},
    Figure{"cuberoot_rms", "cuberoot_rms", "%.4f", &ModelRow::cuberoot_rms, Better::lower},
    Figure{"rel_l2", "rel_l2", "%.4f", &ModelRow::rel_l2, Better::lower},
    Figure{"sphere_psnr_linear_db", "sphere dB", "%.1f", &ModelRow::sphere_psnr_linear_db, Better::higher},
    Figure{"psnr_gamma_db", "gamma dB", "%.1f", &ModelRow::psnr_gamma_db, Better::higher},
    Figure{"ssim", "SSIM", "%.4f", &ModelRow::ssim, Better::higher},
    Figure{"delta_e_2000", "Delta-E", "%.2f", &ModelRow::delta_e_2000, Better::lower},
    Figure{"sampling_efficiency", "efficiency", "%.3f", &ModelRow::sampling_efficiency, Better::neither},
    Figure{"reciprocity_error", "reciprocity", "%.1e", &ModelRow::reciprocity_error, Better::neither},
    Figure{"albedo_max", "albedo", "%.3f", &ModelRow::albedo_max, Better::neither},
};

constexpr const char* kFormat = "sklar-model-comparison";

std::string rank_name(const Figure& figure) {
  return std::string("rank_") + figure.name;
}

/// A number; "inf", "-inf", "nan" for those that JSON does not have.
Json to_number_or_text(double value) {
  return std::isfinite(value) ? Json(value) : Json(sklar::to_text(value));
}

Json row_to_json(const ModelRow& row) {
  Json json = {{"material", row.material},
               {"provenance", to_text(row.provenance)},
               {"kind", row.kind},
               {"model", row.model},
               {"budget", row.budget}};
  for (const Figure& figure : kFigures) json[figure.name] = to_number_or_text(row.*figure.value);
  json["note"] = row.note;
  json["error"] = row.error;
  return json;
}

/// The inverse of to_number_or_text.
double number_or_text(const Json& object, const char* name) {
  const Json& value = json::field(object, name);
  if (!value.is_string()) return json::number(object, name);
  for (const double special : {ModelRow::kNone, HUGE_VAL, -HUGE_VAL}) {
    if (value == sklar::to_text(special)) return special;
  }
  throw std::invalid_argument(std::string("field ") + name + " is \"" + value.get<std::string>() +
                              "\"; allowed are numbers, inf and nan");
}

Provenance provenance_of(const std::string& text) {
  for (const Provenance p : {Provenance::measured, Provenance::reconstruction, Provenance::synthetic}) {
    if (text == to_text(p)) return p;
  }
  return Provenance::unknown;
}

std::string label(const ModelRow& row) {
  return row.budget > 0 ? row.model + ", " + sklar::to_text(row.budget) : row.model;
}

std::string line(const std::vector<std::string>& cells) {
  std::string text = "|";
  for (const std::string& cell : cells) text += " " + cell + " |";
  return text + "\n";
}

/// Headings of the first columns, as text, and of the others, as numbers.
std::string head(std::vector<std::string> headings, std::size_t texts) {
  std::string text = line(headings);
  for (std::size_t i = 0; i < headings.size(); ++i) headings[i] = i < texts ? "---" : "---:";
  return text + line(headings);
}

/// Ranks of every row by one figure; empty for a figure without ranks.
using Ranks = std::vector<double>;

/// Rank of each row among those of its material that have the figure, 1 is best, equals share theirs; NaN for a row
/// without it.
Ranks ranks(std::span<const ModelRow> rows, const Figure& figure) {
  std::map<std::string_view, std::vector<double>> values;  // of each material
  for (const ModelRow& row : rows) {
    if (row.error.empty()) values[row.material].push_back(row.*figure.value);
  }
  Ranks result;
  for (const ModelRow& row : rows) {
    const double own = row.*figure.value;
    int better = 0, equal = 0;
    for (const double value : values[row.material]) {
      better += figure.better == Better::lower ? value < own : value > own;
      equal += value == own;
    }
    result.push_back(equal > 0 ? better + (equal + 1) / 2.0 : ModelRow::kNone);
  }
  return result;
}

/// In the order of kFigures.
std::array<Ranks, kFigures.size()> ranks(std::span<const ModelRow> rows) {
  std::array<Ranks, kFigures.size()> result;
  for (std::size_t f = 0; f < kFigures.size(); ++f) {
    if (kFigures[f].better != Better::neither) result[f] = ranks(rows, kFigures[f]);
  }
  return result;
}

/// What a model has on the materials that have it.
struct Summary {
  std::string label, kind;
  int materials = 0;
  std::array<double, kFigures.size()> sum{};
  double rank = 0;

  [[nodiscard]] double mean_rank() const { return rank / materials; }
};

}  // namespace

std::string to_json(const ModelRow& row) {
  Json document = {{"format", kFormat}, {"version", row.inputs.empty() ? 1 : 2}};
  document.update(row_to_json(row));
  if (!row.inputs.empty()) document["inputs"] = row.inputs;
  return document.dump(1) + "\n";
}

ModelRow model_row_from_json(std::string_view text, std::string_view source) {
  return json::parse(text, source, [](const Json& document) {
    json::require_format(document, kFormat, kModelRowVersion);
    ModelRow row{.material = json::text(document, "material"),
                 .provenance = provenance_of(json::text(document, "provenance")),
                 .kind = json::text(document, "kind"),
                 .model = json::text(document, "model"),
                 .budget = json::number(document, "budget"),
                 .note = json::text(document, "note"),
                 .error = json::text(document, "error"),
                 .inputs = document.contains("inputs") ? json::text(document, "inputs") : ""};
    for (const Figure& figure : kFigures) row.*figure.value = number_or_text(document, figure.name);
    return row;
  });
}

std::string to_json(std::span<const ModelRow> rows) {
  Json document = {{"format", kFormat}, {"version", 1}, {"machine", machine_name()}, {"rows", Json::array()}};
  const auto by_figure = ranks(rows);
  for (std::size_t n = 0; n < rows.size(); ++n) {
    Json row = row_to_json(rows[n]);
    for (std::size_t f = 0; f < kFigures.size(); ++f) {
      if (!by_figure[f].empty()) row[rank_name(kFigures[f])] = to_number_or_text(by_figure[f][n]);
    }
    document["rows"].push_back(std::move(row));
  }
  return document.dump(1) + "\n";
}

std::string to_csv(std::span<const ModelRow> rows) {
  std::string text = "material,provenance,kind,model,budget";
  const auto by_figure = ranks(rows);
  for (const Figure& figure : kFigures) text += std::string(",") + figure.name;
  for (std::size_t f = 0; f < kFigures.size(); ++f) {
    if (!by_figure[f].empty()) text += "," + rank_name(kFigures[f]);
  }
  text += ",note,error\n";
  for (std::size_t n = 0; n < rows.size(); ++n) {
    const ModelRow& row = rows[n];
    text += csv_field(row.material) + "," + to_text(row.provenance) + "," + row.kind + "," + row.model + "," +
            sklar::to_text(row.budget);
    for (const Figure& figure : kFigures) text += "," + printed("%.17g", row.*figure.value);
    for (const Ranks& rank : by_figure) {
      if (!rank.empty()) text += "," + printed("%.17g", rank[n]);
    }
    text += "," + csv_field(row.note) + "," + csv_field(row.error) + "\n";
  }
  return text;
}

std::string to_markdown(std::span<const ModelRow> rows) {
  std::vector<std::string> headings = {"material", "kind", "model"};
  for (const Figure& figure : kFigures) headings.emplace_back(figure.heading);
  std::string text = head(headings, 3);
  for (const ModelRow& row : rows) {
    std::vector<std::string> cells = {row.material, row.kind, label(row)};
    for (const Figure& figure : kFigures) cells.push_back(printed(figure.format, row.*figure.value));
    text += line(cells);
  }
  return text;
}

std::string summary_markdown(std::span<const ModelRow> rows) {
  const auto rank = ranks(rows);
  const auto measures =
      static_cast<double>(std::count_if(rank.begin(), rank.end(), [](const Ranks& r) { return !r.empty(); }));
  std::map<std::string, Summary> by_label;
  for (std::size_t n = 0; n < rows.size(); ++n) {
    if (!rows[n].error.empty()) continue;
    Summary& summary = by_label[label(rows[n])];
    summary.label = label(rows[n]);
    summary.kind = rows[n].kind;
    ++summary.materials;
    for (std::size_t f = 0; f < kFigures.size(); ++f) {
      summary.sum[f] += rows[n].*kFigures[f].value;
      if (!rank[f].empty()) summary.rank += rank[f][n] / measures;
    }
  }
  std::vector<Summary> all;
  all.reserve(by_label.size());
  for (const auto& [name, summary] : by_label) all.push_back(summary);
  std::stable_sort(all.begin(), all.end(),
                   [](const Summary& a, const Summary& b) { return a.mean_rank() < b.mean_rank(); });
  std::vector<std::string> headings = {"kind", "model", "materials", "rank"};
  for (const Figure& figure : kFigures) headings.emplace_back(figure.heading);
  std::string text = head(headings, 2);
  for (const Summary& summary : all) {
    std::vector<std::string> cells = {summary.kind, summary.label, std::to_string(summary.materials),
                                      printed("%.1f", summary.mean_rank())};
    for (std::size_t f = 0; f < kFigures.size(); ++f) {
      cells.push_back(printed(kFigures[f].format, summary.sum[f] / summary.materials));
    }
    text += line(cells);
  }
  return text;
}

}  // namespace sklar::brdf
