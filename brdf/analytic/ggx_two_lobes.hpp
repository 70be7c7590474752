#pragma once
/// Two GGX lobes on a diffuse base: f_r = diffuse / pi + two lobes of ggx.hpp, each with its own f0 and roughness, as a
/// coat over a rougher layer, or a highlight with a haze around it. Nothing dims the one for what the other reflects:
/// the albedo is at most diffuse + 2.

#include "brdf/analytic/ggx.hpp"
#include "brdf/analytic/lambert.hpp"
#include "brdf/analytic/sum.hpp"

namespace sklar::brdf::analytic::ggx_two_lobes {

inline AnalyticInfo info() {
  return {.name = "ggx_two_lobes",
          .title = "Two GGX lobes and Lambert",
          .source = "Walter et al. 2007, eq. 33; Heitz 2014, eq. 99; Schlick 1994; Lambert 1760",
          .parameters = {{"diffuse", Lambert::kAlbedo, 0.2, true},
                         {"f0_1", Ggx::kF0, 0.05, true},
                         {"alpha_1", Ggx::kAlpha, 0.1, false, SearchScale::logarithmic},
                         {"f0_2", Ggx::kF0, 0.05, true},
                         {"alpha_2", Ggx::kAlpha, 0.4, false, SearchScale::logarithmic}},
          .examples = {{0.1, 0.2, 0.3, 0.04, 0.04, 0.04, 0.05, 0.1, 0.2, 0.3, 0.5},
                       {0, 0, 0, 0.9, 0.6, 0.3, 0.2, 0, 0, 0, 1}},
          .make_unchecked = [](const AnalyticValues& v) {
            auto one = std::make_shared<const Ggx>(rgb_at(v, 3), v[6]);
            auto two = std::make_shared<const Ggx>(rgb_at(v, 7), v[10]);
            const Rgb strength = one->strength() + two->strength();
            const double share = one->strength().sum() / strength.sum();
            return with_diffuse(rgb_at(v, 0), std::make_shared<const Sum>(std::move(one), std::move(two), share),
                                strength);
          }};
}

}  // namespace sklar::brdf::analytic::ggx_two_lobes
