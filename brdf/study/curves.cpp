#include "brdf/study/curves.hpp"

#include <numbers>

#include "brdf/geometry/frame.hpp"
#include "brdf/luminance.hpp"
#include "brdf/sampling/sampled_brdf.hpp"
#include "brdf/study/copula_density.hpp"
#include "brdf/study/live_sphere.hpp"
#include "brdf/study/table_text.hpp"
#include "copula/json_fields.hpp"

namespace sklar::brdf {
namespace {

using json::Json;

constexpr double kDegree = std::numbers::pi / 180;
constexpr std::size_t kGreen = 1;
constexpr int kDigits = 4;
constexpr int kMostIncident = 85, kIncidentStep = 5, kMostOutgoing = 89;  // degrees

Json rounded(const Eigen::Ref<const Eigen::ArrayXd>& values) {
  Json array = Json::array();
  for (const double value : values) array.push_back(to_digits(kDigits, value));
  return array;
}

/// f_r at one theta_i over the angles of the axis.
Json lobe(const Brdf& brdf, double theta_i) {
  constexpr int kCount = 2 * kMostOutgoing + 1;
  Directions wo(kCount, 3), wi(kCount, 3);
  for (int n = 0; n < kCount; ++n) {
    wo.row(n) = spherical_direction((n - kMostOutgoing) * kDegree, 0).array();
    wi.row(n) = spherical_direction(-theta_i, 0).array();
  }
  const RgbRows values = brdf.eval(wo, wi);
  Eigen::ArrayXd lobe(kCount);
  for (int n = 0; n < kCount; ++n) lobe(n) = luminance(values.row(n).transpose());
  return rounded(lobe);
}

/// What a sampler was made for, else the reflectance itself.
const Brdf& without_sampler(const Brdf& brdf) {
  const auto* sampled = dynamic_cast<const SampledBrdf*>(&brdf);
  return sampled != nullptr ? *sampled->brdf() : brdf;
}

template <class Centre>
Json centres(int count, const Centre& centre) {
  Json array = Json::array();
  for (int n = 0; n < count; ++n) array.push_back(to_digits(kDigits, centre(n) / kDegree));
  return array;
}

}  // namespace

std::string curves_json(const Brdf& brdf, const View& view) {
  Json json = {{"lobes", Json::array()}, {"albedo", Json::array()}};
  for (int theta_i = 0; theta_i <= kMostIncident; theta_i += kIncidentStep) {
    json["lobes"].push_back(lobe(brdf, theta_i * kDegree));
  }
  for (int channel = 0; channel < 3; ++channel) json["albedo"].push_back(rounded(view.albedo.albedo.col(channel)));
  const CellShares shares = cell_shares(view.cells[kGreen]);
  json["theta_h"] = rounded(shares.theta_h);
  json["phi_d"] = rounded(shares.phi_d);
  const Brdf& model = without_sampler(brdf);
  json["copulas"] = Json::parse(copula_densities_json(model));
  if (const auto* refined = dynamic_cast<const RefinedBrdf*>(&model)) {
    json["live"] = Json::parse(live_sphere_json(*refined));
  }
  return json.dump();
}

std::string curve_axes_json() {
  Json json = {{"lobe_theta_i", Json::array()}, {"lobe_theta_o", Json::array()}};
  for (int angle = 0; angle <= kMostIncident; angle += kIncidentStep) json["lobe_theta_i"].push_back(angle);
  for (int angle = -kMostOutgoing; angle <= kMostOutgoing; ++angle) json["lobe_theta_o"].push_back(angle);
  json["albedo_theta_o"] = rounded(albedo_angles() / kDegree);
  json["theta_h"] = centres(Grid::theta_h, Grid::theta_h_centre);
  json["phi_d"] = centres(Grid::phi_d, Grid::phi_d_centre);
  return json.dump();
}

}  // namespace sklar::brdf
