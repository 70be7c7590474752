#pragma once
/// Reflectance models that comparisons name and that are not in the list, with the reason: the rows of a table that
/// have no figures.

#include <array>
#include <string_view>

namespace sklar::brdf::analytic {

struct NotComputable {
  std::string_view name;    ///< as printed
  std::string_view source;  ///< reference
  std::string_view why;     ///< one sentence, without the name
};

/// The models that are not here, with the reason.
inline constexpr std::array kNotComputable = {
    NotComputable{
        "He, Torrance, Sillion and Greenberg",
        "He, Torrance, Sillion and Greenberg 1991, A Comprehensive Physical Model for Light Reflection",
        "It is a function of wavelength whose directional diffuse term is an infinite series in the heights "
        "and correlation length of the surface and needs its complex index of refraction by wavelength, which "
        "red, green and blue of a measured table do not determine."},
    NotComputable{"Kajiya", "Kajiya 1985, Anisotropic Reflection Models",
                  "It is the scattering integral of a given bumpy surface, tabulated from its height field: it has no "
                  "closed form whose parameters a table could be fitted by."},
    NotComputable{"Poulin and Fournier", "Poulin and Fournier 1990, A Model for Anisotropic Reflection",
                  "It adds up the light from parallel cylinders on a surface over their visible and lit parts: without "
                  "them it has no highlight and with them it is anisotropic, so that no isotropic table can be set "
                  "beside it."},
    NotComputable{"Westlund and Meyer",
                  "Westlund and Meyer 2001, Applying Appearance Standards to Light Reflection Models",
                  "It has no reflectance of its own: it gives parameters of the Phong, Ward and Cook-Torrance models, "
                  "which are in the list, from readings of gloss and haze meters."},
};

}  // namespace sklar::brdf::analytic
