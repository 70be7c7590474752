#pragma once
/// The files of brdf/study/report/ as they are embedded in the library.

#include <string_view>

namespace sklar::brdf::report {

[[nodiscard]] std::string_view page_html();
[[nodiscard]] std::string_view page_css();
[[nodiscard]] std::string_view sphere_glsl();

/// The library that plots, and the page's own scripts.
[[nodiscard]] std::string_view scripts();

}  // namespace sklar::brdf::report
