#pragma once
/// GGX with two roughnesses: the formulas of ggx.hpp.

#include "brdf/analytic/ggx.hpp"

namespace sklar::brdf::analytic::ggx_anisotropic {

inline AnalyticInfo info() {
  return {
      .name = "ggx_anisotropic",
      .title = "GGX, anisotropic",
      .source = "Heitz 2018, eqs. 1 to 3; Heitz 2014, eq. 99; Schlick 1994",
      .parameters = {{"f0", Ggx::kF0, 0.5, true},
                     {"alpha_x", Ggx::kAlpha, 0.2, false, SearchScale::logarithmic},
                     {"alpha_y", Ggx::kAlpha, 0.4, false, SearchScale::logarithmic, "alpha_x"}},
      .examples = {{0.04, 0.5, 1, 0.02, 0.08}, {0.04, 0.5, 1, 0.1, 0.5}, {0, 0, 0, 1, 0.2}, {0, 1, 0, 0.3, 0.3}},
      .make_unchecked = [](const AnalyticValues& v) { return std::make_shared<const Ggx>(rgb_at(v, 0), v[3], v[4]); },
      .isotropic_form = "ggx"};
}

}  // namespace sklar::brdf::analytic::ggx_anisotropic
