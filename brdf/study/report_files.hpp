#pragma once
/// The files of brdf/study/report/ as they are embedded in the library.

#include <string_view>

namespace sklar::brdf::report {

[[nodiscard]] std::string_view frame_html();
[[nodiscard]] std::string_view page_css();
[[nodiscard]] std::string_view table_html();

/// The library that plots, and the scripts of all pages.
[[nodiscard]] std::string_view scripts();

[[nodiscard]] std::string_view compare_html();
[[nodiscard]] std::string_view compare_scripts();
[[nodiscard]] std::string_view sphere_glsl();

[[nodiscard]] std::string_view fit_html();
[[nodiscard]] std::string_view fit_scripts();

[[nodiscard]] std::string_view cost_html();
[[nodiscard]] std::string_view cost_scripts();

}  // namespace sklar::brdf::report
