#pragma once
/// A comparison as one page that a browser shows without a network.

#include <filesystem>
#include <span>
#include <string>

#include "brdf/data/measured_table.hpp"
#include "brdf/render/image.hpp"

namespace sklar::brdf {

/// What the page shows of one material; spheres and curves in the order of its rows, empty where there is no model.
struct ReportMaterial {
  std::string name;
  Provenance provenance;
  const Image& reference;
  const std::string& reference_curves;  ///< this and the next: curves_json, or empty for none
  std::span<const Image> spheres;
  std::span<const std::string> curves;
};

/// The page: a table of the rows, pictures of the spheres at the display exposure of their reference, and plots. It
/// loads nothing: style, scripts, pictures and data are in it.
/// @param rows the document of to_json of a comparison's rows, material after material.
/// @throws std::invalid_argument unless every row has its sphere and curves.
[[nodiscard]] std::string report_page(std::string_view rows, std::span<const ReportMaterial> materials);

}  // namespace sklar::brdf
