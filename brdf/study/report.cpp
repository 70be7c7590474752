#include "brdf/study/report.hpp"

#include <cmath>
#include <stdexcept>
#include <string_view>

#include "brdf/study/base64.hpp"
#include "brdf/study/curves.hpp"
#include "brdf/study/figures.hpp"
#include "brdf/study/report_frame.hpp"
#include "copula/json_fields.hpp"
#include "copula/plot/axis.hpp"

namespace sklar::brdf {
namespace {

using json::Json;

Json picture(const Image& image, double exposure) {
  if (image.rgb.empty()) return nullptr;
  return png_url(to_srgb(image, exposure));
}

Json curves(const std::string& text) {
  return text.empty() ? Json(nullptr) : Json::parse(text);
}

/// The colours of the difference, as the figures have them.
Json colour_map() {
  Json colours = Json::array();
  for (int n = 0; n < 256; ++n) {
    const plot::Colour colour = plot::viridis(n / 255.0);
    Json entry = Json::array();
    for (const double value : {colour.red, colour.green, colour.blue}) entry.push_back(std::lround(255 * value));
    colours.push_back(std::move(entry));
  }
  return colours;
}

}  // namespace

std::string report_page(std::string_view rows, std::span<const ReportMaterial> materials) {
  Json data = Json::parse(rows);
  data["axes"] = Json::parse(curve_axes_json());
  data["colour_map"] = colour_map();
  data["materials"] = Json::array();
  std::size_t next = 0;
  for (const ReportMaterial& material : materials) {
    const double exposure = display_exposure(material.reference);
    data["materials"].push_back({{"name", material.name},
                                 {"provenance", to_text(material.provenance)},
                                 {"picture", picture(material.reference, exposure)},
                                 {"curves", curves(material.reference_curves)}});
    for (std::size_t n = 0; n < material.spheres.size(); ++n, ++next) {
      Json& row = data["rows"].at(next);
      row["picture"] = picture(material.spheres[n], exposure);
      row["curves"] = curves(material.curves[n]);
    }
  }
  if (next != data["rows"].size()) {
    throw std::invalid_argument("report_page: " + std::to_string(data["rows"].size()) + " rows, but " +
                                std::to_string(next) + " spheres");
  }
  return report_file(ReportKind::comparison, "Reflectance models compared", data.dump());
}

}  // namespace sklar::brdf
