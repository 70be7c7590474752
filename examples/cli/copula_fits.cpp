#include "examples/cli/copula_fits.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <tuple>

#include "examples/cli/fit_intervals.hpp"
#include "examples/cli/text.hpp"

namespace sklar::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Smaller is better.
double value_of(Criterion criterion, const FamilyFit& family, bool densities) {
  switch (criterion) {
    case Criterion::aic:
      return densities ? family.fit.aic : family.fit.copula.aic;
    case Criterion::bic:
      return densities ? family.fit.bic : family.fit.copula.bic;
    case Criterion::held_out:
      return family.held_out ? -family.held_out->mean : FitResult::kNone;
  }
  return FitResult::kNone;
}

Json json_of(const std::vector<MarginFit>& margins, const Sample& sample) {
  Json list = Json::array();
  for (std::size_t i = 0; i < margins.size(); ++i) {
    const MarginFit& margin = margins[i];
    Json entry{{"column", sample.names[i]}, {"kind", to_text(margin.spec.kind)}};
    const auto names = parameter_names(margin.spec.kind);
    for (std::size_t k = 0; k < names.size(); ++k) {
      entry["parameters"][std::string(names[k])] = json_number(margin.parameters[k]);
      entry["se"][std::string(names[k])] = json_number(margin.standard_error[k]);
    }
    if (!names.empty()) entry["loglik"] = json_number(margin.log_likelihood);
    list.push_back(std::move(entry));
  }
  return list;
}

}  // namespace

void sort_by(Criterion criterion, Fits& fits) {
  const auto rank = [&](const FamilyFit& family) {
    const double value = value_of(criterion, family, fits.densities);
    return std::tuple(family.fit.copula.status == FitStatus::failed, std::isnan(value), std::isnan(value) ? 0 : value);
  };
  std::stable_sort(fits.families.begin(), fits.families.end(),
                   [&](const FamilyFit& a, const FamilyFit& b) { return rank(a) < rank(b); });
}

std::string json_of(const Fits& fits, const Sample& sample) {
  Json document;
  for (const FamilyFit& family : fits.families) {
    const FitResult& result = family.fit.copula;
    Json entry{{"name", result.family},
               {"theta", json_numbers(result.theta)},
               {"tau", json_number(result.tau)},
               {"loglik", json_number(result.log_likelihood)},
               {"aic", json_number(result.aic)},
               {"bic", json_number(result.bic)},
               {"se", json_numbers(result.standard_error)},
               {"status", to_text(result.status)},
               {"evaluations", result.evaluations},
               {"message", result.message}};
    if (fits.densities) {
      entry["joint_loglik"] = json_number(family.fit.log_likelihood);
      entry["joint_aic"] = json_number(family.fit.aic);
      entry["joint_bic"] = json_number(family.fit.bic);
    }
    if (family.held_out) {
      entry["heldout"] = json_number(family.held_out->mean);
      entry["heldout_se"] = json_number(family.held_out->standard_error);
      entry["heldout_message"] = family.held_out->message;
    }
    if (family.intervals) entry["intervals"] = interval_json(*family.intervals, family.fit, sample.names);
    if (fits.together) entry["margins"] = json_of(family.fit.margins, sample);
    document["families"].push_back(std::move(entry));
  }
  document["best"] = fits.families.front().fit.copula.family;
  document["rows"] = sample.x.rows();
  document["total_weight"] = sample.total_weight();
  document["dropped"] = sample.dropped;
  if (!fits.together) document["margins"] = json_of(fits.families.front().fit.margins, sample);
  return document.dump(2) + '\n';
}

std::string csv_of(const Fits& fits) {
  const bool held_out = fits.families.front().held_out.has_value();
  std::string out = "name,theta,tau,loglik,aic,bic,se,status,evaluations,message";
  out += fits.densities ? ",joint_loglik,joint_aic,joint_bic" : "";
  out += held_out ? ",heldout,heldout_se,heldout_message" : "";
  out += fits.families.front().intervals ? interval_header() : "";
  out += '\n';
  for (const FamilyFit& family : fits.families) {
    const FitResult& result = family.fit.copula;
    out += csv_field(result.family) + ',' + digits(result.theta) + ',' + digits(result.tau) + ',' +
           digits(result.log_likelihood) + ',' + digits(result.aic) + ',' + digits(result.bic) + ',' +
           digits(result.standard_error) + ',' + std::string(to_text(result.status)) + ',' +
           std::to_string(result.evaluations) + ',' + csv_field(result.message);
    if (fits.densities) {
      out += ',' + digits(family.fit.log_likelihood) + ',' + digits(family.fit.aic) + ',' + digits(family.fit.bic);
    }
    if (held_out) {
      out += ',' + digits(family.held_out->mean) + ',' + digits(family.held_out->standard_error) + ',' +
             csv_field(family.held_out->message);
    }
    if (family.intervals) out += interval_fields(*family.intervals);
    out += '\n';
  }
  return out;
}

CopulaModel model_of(const FamilyFit& fit, const std::vector<std::string>& columns) {
  CopulaModel model{.dim = static_cast<int>(columns.size()), .components = {}, .columns = columns};
  model.components.push_back(
      {.family = fit.family->name, .theta = fit.fit.copula.theta, .definition = fit.family->definition});
  for (const MarginFit& margin : fit.fit.margins) model.margins.push_back(margin.margin);
  return model;
}

}  // namespace sklar::cli
