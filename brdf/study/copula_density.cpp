#include "brdf/study/copula_density.hpp"

#include <algorithm>
#include <numbers>

#include "brdf/model/paper_brdf.hpp"
#include "brdf/model/refined_brdf.hpp"
#include "brdf/study/table_text.hpp"
#include "copula/json_fields.hpp"
#include "families/registry.hpp"

namespace sklar::brdf {
namespace {

using json::Json;

constexpr int kNodes = 24;  ///< a side
constexpr std::size_t kGreen = 1;
constexpr int kDigits = 5;

/// An entry; null where two coordinates alone do not have the family.
Json entry(const FamilyInfo& family, const Theta& theta, double theta_d, int component) {
  if (!family.admits(2, theta)) return nullptr;
  return {{"theta_d", theta_d},
          {"component", component},
          {"tau", to_digits(kDigits, family.tau(theta))},
          {"density", Json::parse(pair_density_json(*family.make(2, theta), kNodes))}};
}

Json of_paper(const PaperBrdf& brdf) {
  const FamilyInfo family = brdf.definition().empty() ? families::find(brdf.family())
                                                      : families::from_definition(brdf.definition(), brdf.family());
  Json array = Json::array();
  for (int slice = 0; slice < brdf.slices(); ++slice) {
    const PaperSlice& green = brdf.channels()[kGreen][static_cast<std::size_t>(slice)];
    if (green.scale > 0) array.push_back(entry(family, green.theta, (slice + 0.5) * 90 / brdf.slices(), 1));
  }
  return array;
}

Json of_refined(const RefinedBrdf& brdf) {
  Json array = Json::array();
  for (const double theta_d : {15, 45, 75}) {
    for (int k = 0; k < static_cast<int>(brdf.families().size()); ++k) {
      const FamilyInfo& family = brdf.families()[static_cast<std::size_t>(k)];
      if (family.parameters.empty()) continue;
      const double tau = brdf.tau(k, theta_d * std::numbers::pi / 180);
      array.push_back(entry(family, family.from_tau(2, tau), theta_d, k + 1));
    }
  }
  return array;
}

}  // namespace

std::string pair_density_json(const Copula& copula, int nodes) {
  Points u(Index{nodes} * nodes, 2);
  for (Index n = 0; n < u.rows(); ++n) {
    const Index i = n / nodes, j = n % nodes;
    u.row(n) << (static_cast<double>(i) + 0.5) / nodes, (static_cast<double>(j) + 0.5) / nodes;
  }
  const Column density = copula.log_conditional_pdf(u).exp();  // the margin of the first coordinate is uniform
  Json rows = Json::array();
  for (Index i = 0; i < nodes; ++i) {
    Json row = Json::array();
    for (Index j = 0; j < nodes; ++j) row.push_back(to_digits(kDigits, density(i * nodes + j)));
    rows.push_back(std::move(row));
  }
  return rows.dump();
}

std::string copula_densities_json(const Brdf& brdf) {
  Json array = Json::array();
  if (const auto* paper = dynamic_cast<const PaperBrdf*>(&brdf)) array = of_paper(*paper);
  if (const auto* refined = dynamic_cast<const RefinedBrdf*>(&brdf)) array = of_refined(*refined);
  array.erase(std::remove(array.begin(), array.end(), nullptr), array.end());
  return array.dump();
}

}  // namespace sklar::brdf
