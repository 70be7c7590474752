#include "brdf/study/efficiency.hpp"

#include <tbb/parallel_for.h>

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <stdexcept>

#include "brdf/analytic/ggx.hpp"
#include "brdf/analytic/lambert.hpp"
#include "brdf/analytic/sum.hpp"
#include "brdf/geometry/frame.hpp"
#include "brdf/luminance.hpp"
#include "brdf/render/hemisphere.hpp"
#include "brdf/sampling/paper_sampler.hpp"
#include "brdf/sampling/sampled_brdf.hpp"
#include "brdf/study/table_text.hpp"
#include "families/registry.hpp"

namespace sklar::brdf {
namespace {

constexpr HemisphereOptions kNodes = {.polar = 160, .azimuth = 160};

/// The light at quadrature nodes of one theta_o.
struct Furnace {
  Vec3 wo;
  Directions wi;
  Eigen::ArrayXd light, solid_angle;

  Furnace(const Brdf& brdf, double theta_o) : wo(spherical_direction(theta_o, 0)) {
    const HemisphereNodes nodes = hemisphere_nodes(theta_o, kNodes);
    wi = nodes.wi;
    solid_angle = nodes.weight / wi.col(2);
    Directions all(wi.rows(), 3);
    all.rowwise() = wo.transpose().array();
    const RgbRows f = brdf.eval(all, wi);
    light.resize(wi.rows());
    for (Eigen::Index i = 0; i < wi.rows(); ++i) light(i) = luminance(f.row(i).transpose()) * wi(i, 2);
  }

  [[nodiscard]] Eigen::ArrayXd values(const std::function<double(const Vec3&)>& of_wi) const {
    Eigen::ArrayXd result(wi.rows());
    for (Eigen::Index i = 0; i < wi.rows(); ++i) result(i) = of_wi(Vec3(wi.row(i).transpose()));
    return result;
  }

  [[nodiscard]] double variance(const Eigen::ArrayXd& pdf) const {
    const double mean = (light * solid_angle).sum();
    const double square = (light > 0).select(light.square() / pdf * solid_angle, 0.0).sum();
    return std::max(square / (mean * mean) - 1, 0.0);
  }
};

using Furnaces = std::vector<Furnace>;
using Deviations = std::array<double, kEfficiencyAngles.size()>;

Deviations deviations(const Furnaces& furnaces, const std::function<double(const Vec3&, const Vec3&)>& pdf) {
  Deviations result;
  tbb::parallel_for(std::size_t{0}, furnaces.size(), [&](std::size_t i) {
    const Furnace& at = furnaces[i];
    result[i] = std::sqrt(at.variance(at.values([&](const Vec3& wi) { return pdf(at.wo, wi); })));
  });
  return result;
}

/// A mixture of the cosine and GGX.
struct GgxMixture {
  double alpha = 1, share = 1;  ///< roughness of GGX, share of the cosine
  double variance = std::numeric_limits<double>::infinity();
  Deviations deviation{};
};

/// The one whose mean variance over the angles is least, on a lattice.
GgxMixture best_ggx(const Furnaces& furnaces) {
  constexpr int kRoughnesses = 24;
  std::vector<GgxMixture> best(kRoughnesses);
  tbb::parallel_for(0, kRoughnesses, [&](int n) {
    const double alpha = 0.004 * std::pow(250, n / (kRoughnesses - 1.0));
    const Ggx ggx(Rgb::Ones(), alpha);
    std::vector<Eigen::ArrayXd> lobe;
    for (const Furnace& at : furnaces) lobe.push_back(at.values([&](const Vec3& wi) { return ggx.pdf(at.wo, wi); }));
    for (const double share : {0.01, 0.03, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.97}) {
      GgxMixture candidate{.alpha = alpha, .share = share, .variance = 0};
      for (std::size_t i = 0; i < furnaces.size(); ++i) {
        const double variance =
            furnaces[i].variance(share * std::numbers::inv_pi * furnaces[i].wi.col(2) + (1 - share) * lobe[i]);
        candidate.variance += variance;
        candidate.deviation[i] = std::sqrt(variance);
      }
      auto& least = best[static_cast<std::size_t>(n)];
      if (candidate.variance < least.variance) least = candidate;
    }
  });
  return *std::min_element(best.begin(), best.end(),
                           [](const GgxMixture& a, const GgxMixture& b) { return a.variance < b.variance; });
}

/// The weights of Eq. 24 under their own draws.
Deviations printed_deviations(const Furnaces& furnaces, const PaperSampledBrdf& paper) {
  Deviations result;
  for (std::size_t i = 0; i < furnaces.size(); ++i) {
    const Furnace& at = furnaces[i];
    const Eigen::ArrayXd share = at.values([&](const Vec3& wi) { return paper.pdf(at.wo, wi); }) * at.solid_angle;
    const Eigen::ArrayXd weight = at.values([&](const Vec3& wi) { return paper.printed_weight(at.wo, wi); });
    const double mean = (weight * share).sum() / share.sum();
    result[i] = std::sqrt(((weight / mean - 1).square() * share).sum() / share.sum());
  }
  return result;
}

/// @throws std::invalid_argument for an anisotropic reflectance.
Furnaces furnaces_of(const char* function, const Brdf& brdf) {
  if (!brdf.traits().isotropic) throw std::invalid_argument(std::string(function) + ": the BRDF must be isotropic");
  Furnaces furnaces;
  for (const double theta : kEfficiencyAngles) furnaces.emplace_back(brdf, theta * std::numbers::pi / 180);
  return furnaces;
}

}  // namespace

double weight_deviation(const Brdf& sampled, double theta_o) {
  const Furnace at(sampled, theta_o);
  return std::sqrt(at.variance(at.values([&](const Vec3& wi) { return sampled.pdf(at.wo, wi); })));
}

BrdfPtr ggx_sampler(const Brdf& brdf) {
  const GgxMixture best = best_ggx(furnaces_of("ggx_sampler", brdf));
  return std::make_shared<const Sum>(std::make_shared<const Lambert>(Rgb::Ones()),
                                     std::make_shared<const Ggx>(Rgb::Ones(), best.alpha), best.share);
}

std::vector<SamplerEfficiency> sampling_efficiency(const std::string& material, const BrdfPtr& brdf) {
  const Furnaces furnaces = furnaces_of("sampling_efficiency", *brdf);
  const FamilyInfo& frank = families::find("frank");
  const SampledBrdf ours(brdf);
  const PaperSampledBrdf paper(brdf, frank, PaperTarget::reflectance);
  const PaperSampledBrdf corrected(brdf, frank, PaperTarget::reflected_light);
  const auto by = [](const Brdf& sampler) {
    return [&sampler](const Vec3& wo, const Vec3& wi) { return sampler.pdf(wo, wi); };
  };
  const auto cosine = [](const Vec3&, const Vec3& wi) { return wi.z() * std::numbers::inv_pi; };
  return {{material, "conditional", deviations(furnaces, by(ours))},
          {material, "cosine", deviations(furnaces, cosine)},
          {material, "ggx", best_ggx(furnaces).deviation},
          {material, "paper", deviations(furnaces, by(paper))},
          {material, "paper-cosine", deviations(furnaces, by(corrected))},
          {material, "paper-eq24", printed_deviations(furnaces, paper)}};
}

std::string efficiency_csv(std::span<const SamplerEfficiency> rows) {
  std::string text = "material,sampler";
  for (const double theta : kEfficiencyAngles) text += printed(",theta_%g", theta);
  text += '\n';
  for (const SamplerEfficiency& row : rows) {
    text += row.material + ',' + row.sampler;
    for (const double value : row.deviation) text += printed(",%.17g", value);
    text += '\n';
  }
  return text;
}

std::string efficiency_markdown(std::span<const SamplerEfficiency> rows) {
  std::string text = "| material | sampler |", line = "| --- | --- |";
  for (const double theta : kEfficiencyAngles) {
    text += printed(" %g |", theta);
    line += " ---: |";
  }
  text += '\n' + line + '\n';
  for (const SamplerEfficiency& row : rows) {
    text += "| " + row.material + " | " + row.sampler + " |";
    for (const double value : row.deviation) text += printed(" %.3f |", value);
    text += '\n';
  }
  return text;
}

}  // namespace sklar::brdf
