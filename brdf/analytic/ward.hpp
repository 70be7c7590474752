#pragma once
/// Ward 1992, "Measuring and Modeling Anisotropic Reflection", eqs. 5a and 5b: f_r = diffuse / pi + the lobe of
/// ward_lobe.hpp.

#include "brdf/analytic/info.hpp"
#include "brdf/analytic/lambert.hpp"
#include "brdf/analytic/sum.hpp"
#include "brdf/analytic/ward_lobe.hpp"

namespace sklar::brdf::analytic::ward {

inline AnalyticInfo info() {
  return {.name = "ward",
          .title = "Ward",
          .source = "Ward 1992, eqs. 5a and 5b",
          .parameters = {{"diffuse", Lambert::kAlbedo, 0.2, true},
                         {"specular", WardLobe::kSpecular, 0.2, true},
                         {"alpha_x", WardLobe::kAlpha, 0.1, false, SearchScale::logarithmic},
                         {"alpha_y", WardLobe::kAlpha, 0.2, false, SearchScale::logarithmic, "alpha_x"}},
          // rolled brass, enamel finished metal, white ceramic tile (Ward 1992, table 1), and a metal of the roughest.
          .examples = {{0.1, 0.1, 0.1, 0.33, 0.33, 0.33, 0.05, 0.16},
                       {0.25, 0.25, 0.25, 0.047, 0.047, 0.047, 0.08, 0.096},
                       {0.7, 0.7, 0.7, 0.05, 0.05, 0.05, 0.071, 0.071},
                       {0, 0, 0, 0, 0.5, 1, 1, 0.3}},
          .make_unchecked = [](const AnalyticValues& v) {
            const Rgb specular = rgb_at(v, 3);
            auto lobe = std::make_shared<const WardLobe>(specular, v[6], v[7], WardNormalisation::ward);
            return with_diffuse(rgb_at(v, 0), std::move(lobe), specular);
          }};
}

}  // namespace sklar::brdf::analytic::ward
