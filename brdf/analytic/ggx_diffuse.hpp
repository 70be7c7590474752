#pragma once
/// GGX on a diffuse base: f_r = diffuse / pi + the lobe of ggx.hpp. The base is not dimmed by what the lobe reflects:
/// the albedo is at most diffuse + 1, and diffuse + f0 or so at normal incidence.

#include "brdf/analytic/ggx.hpp"
#include "brdf/analytic/lambert.hpp"
#include "brdf/analytic/sum.hpp"

namespace sklar::brdf::analytic::ggx_diffuse {

inline AnalyticInfo info() {
  return {.name = "ggx_diffuse",
          .title = "GGX and Lambert",
          .source = "Walter et al. 2007, eq. 33; Heitz 2014, eq. 99; Schlick 1994; Lambert 1760",
          .parameters = {{"diffuse", Lambert::kAlbedo, 0.2, true},
                         {"f0", Ggx::kF0, 0.05, true},
                         {"alpha", Ggx::kAlpha, 0.3, false, SearchScale::logarithmic}},
          .examples = {{0.1, 0.2, 0.3, 0.04, 0.04, 0.04, 0.1}, {0.8, 0.5, 0, 0, 0.2, 1, 0.6}},
          .make_unchecked = [](const AnalyticValues& v) {
            auto lobe = std::make_shared<const Ggx>(rgb_at(v, 3), v[6]);
            const Rgb strength = lobe->strength();
            return with_diffuse(rgb_at(v, 0), std::move(lobe), strength);
          }};
}

}  // namespace sklar::brdf::analytic::ggx_diffuse
