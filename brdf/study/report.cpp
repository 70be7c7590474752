#include "brdf/study/report.hpp"

#include <cmath>
#include <stdexcept>
#include <string_view>

#include "brdf/study/base64.hpp"
#include "brdf/study/curves.hpp"
#include "brdf/study/figures.hpp"
#include "brdf/study/report_files.hpp"
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

/// JSON in which no "</script>" or "<!--" can stand.
std::string embedded(const Json& json) {
  std::string text;
  for (const char c : json.dump()) {
    if (c == '<') {
      text += "\\u003c";
    } else {
      text += c;
    }
  }
  return text;
}

std::string filled(std::string page, std::string_view marker, std::string_view text) {
  return page.replace(page.find(marker), marker.size(), text);
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
  std::string page(report::page_html());
  page = filled(std::move(page), "/*style*/", report::page_css());
  page = filled(std::move(page), "/*sphere*/", report::sphere_glsl());
  page = filled(std::move(page), "/*scripts*/", report::scripts());
  return filled(std::move(page), "{\"data\": null}", embedded(data));  // the last, since it may hold any text
}

}  // namespace sklar::brdf
