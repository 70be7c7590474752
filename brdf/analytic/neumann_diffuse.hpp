#pragma once
/// Neumann's lobe, of metals, on a diffuse base: f_r = diffuse / pi + the lobe of neumann.hpp.

#include "brdf/analytic/lambert.hpp"
#include "brdf/analytic/neumann.hpp"
#include "brdf/analytic/sum.hpp"

namespace sklar::brdf::analytic::neumann_diffuse {

inline AnalyticInfo info() {
  return {.name = "neumann_diffuse",
          .title = "Neumann (stretched Phong) and Lambert",
          .source = "Neumann, Neumann and Szirmay-Kalos 1999, Compact Metallic Reflectance Models; Lambert 1760",
          .parameters = {{"diffuse", Lambert::kAlbedo, 0.2, true},
                         {"specular", Neumann::kSpecular, 0.2, true},
                         {"exponent", Neumann::kExponent, 100, false, SearchScale::logarithmic}},
          .examples = {{0.3, 0.2, 0.1, 0.1, 0.1, 0.1, 200}, {0.5, 0.5, 0, 0, 0.5, 1, 3}},
          .make_unchecked = [](const AnalyticValues& v) {
            const Rgb specular = rgb_at(v, 3);
            return with_diffuse(rgb_at(v, 0), std::make_shared<const Neumann>(specular, v[6]), specular);
          }};
}

}  // namespace sklar::brdf::analytic::neumann_diffuse
