#include "brdf/study/report.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "brdf/analytic/lambert.hpp"
#include "brdf/analytic/synthetic.hpp"
#include "brdf/code/model_code.hpp"
#include "brdf/model/refined_fit.hpp"
#include "brdf/study/base64.hpp"
#include "brdf/study/copula_density.hpp"
#include "brdf/study/curves.hpp"
#include "brdf/study/live_sphere.hpp"
#include "brdf/study/model_comparison.hpp"
#include "brdf/study/report_frame.hpp"
#include "brdf/study/table_text.hpp"
#include "families/registry.hpp"

namespace sklar::brdf {
namespace {

using nlohmann::json;

const std::string kDataBegin = "<script type=\"application/json\" id=\"data\">";

std::string data_of(const std::string& page) {
  const std::size_t begin = page.find(kDataBegin) + kDataBegin.size();
  return page.substr(begin, page.find("</script>", begin) - begin);
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t result = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++result;
  return result;
}

/// A page of one material and one model.
std::string page_of(const std::string& name) {
  const ModelRow row{.material = name, .provenance = Provenance::synthetic, .kind = "analytic", .model = "lambert"};
  const Image sphere(4, 4);
  const std::string curves = "{\"theta_h\":[1]}";
  const std::vector<Image> spheres = {sphere};
  const std::vector<std::string> all_curves = {curves};
  const ReportMaterial material{name, row.provenance, sphere, curves, spheres, all_curves};
  return report_page(to_json(std::span(&row, 1)), std::span(&material, 1));
}

TEST(Base64, IsThatOfTheStandard) {  // RFC 4648, section 10
  const std::vector<std::pair<std::string, std::string>> vectors = {{"", ""},
                                                                    {"f", "Zg=="},
                                                                    {"fo", "Zm8="},
                                                                    {"foo", "Zm9v"},
                                                                    {"foob", "Zm9vYg=="},
                                                                    {"fooba", "Zm9vYmE="},
                                                                    {"foobar", "Zm9vYmFy"},
                                                                    {"\xff\xfe", "//4="}};
  for (const auto& [bytes, text] : vectors) EXPECT_EQ(base64(bytes), text);
}

TEST(ToDigits, RoundsNumbersBelowTheNormalOnes) {
  EXPECT_EQ(to_digits(3, 1.2345e-310), 1.23e-310);
  EXPECT_EQ(to_digits(3, -1.2355e5), -1.24e5);
}

TEST(ReportPage, HoldsRowsPicturesAndCurves) {
  const json data = json::parse(data_of(page_of("felt")));
  ASSERT_EQ(data["rows"].size(), 1U);
  EXPECT_EQ(data["rows"][0]["model"], "lambert");
  EXPECT_EQ(data["rows"][0]["curves"]["theta_h"][0], 1);
  EXPECT_EQ(data["materials"][0]["provenance"], "synthetic");
  for (const json& picture : {data["rows"][0]["picture"], data["materials"][0]["picture"]}) {
    EXPECT_TRUE(picture.get<std::string>().starts_with("data:image/png;base64,iVBORw0KGgo")) << picture;
  }
  EXPECT_EQ(data["colour_map"].size(), 256U);
}

TEST(ReportPage, NamesStayText) {
  const std::string plain = page_of("felt");
  for (const std::string name : {"</script><script>alert(1)</script>", "<!--<script>", "/*scripts*/", "\"\\\n\u2028"}) {
    const std::string page = page_of(name);
    EXPECT_EQ(json::parse(data_of(page))["materials"][0]["name"], name);
    EXPECT_EQ(count(page, "<script"), count(plain, "<script")) << name;
    EXPECT_EQ(count(page, "</script"), count(plain, "</script")) << name;
    EXPECT_EQ(count(page, "<!--"), count(plain, "<!--")) << name;
  }
}

TEST(ReportPage, LoadsNothing) {
  for (const ReportKind kind : {ReportKind::comparison, ReportKind::fit, ReportKind::cost}) {
    const std::string page = report_file(kind, "Title", "{}");
    EXPECT_EQ(count(page, "default-src 'none'"), 1U);
    for (const char* load :
         {" src=", "src=\"http", "href=\"http", "@import", "url(", "fetch(", "XMLHttpRequest", "import("}) {
      EXPECT_EQ(count(page, load), 0U) << load;
    }
  }
}

TEST(ReportPage, EveryPageIsFilled) {
  for (const ReportKind kind : {ReportKind::comparison, ReportKind::fit, ReportKind::cost}) {
    const std::string page = report_file(kind, "Title", R"({"rows": []})");
    for (const char* marker : {"/*title*/", "/*style*/", "/*body*/", "/*table*/", "/*sphere*/", "/*scripts*/"}) {
      EXPECT_EQ(count(page, marker), 0U) << marker;
    }
    EXPECT_EQ(count(page, "Title</"), 2U);
    EXPECT_EQ(count(page, "<table id=\"table\">"), 1U);
    EXPECT_EQ(data_of(page), R"({"rows": []})");
  }
  EXPECT_THROW((void)report_file(ReportKind::cost, "Title", "{"), std::invalid_argument);
}

TEST(ReportPage, EveryRowHasItsSphere) {
  const ModelRow row{.material = "felt", .kind = "analytic", .model = "lambert"};
  EXPECT_THROW((void)report_page(to_json(std::span(&row, 1)), {}), std::invalid_argument);
}

TEST(Curves, OfLambertAreFlat) {
  const auto table = std::make_shared<const MeasuredTable>(builtin_material());
  const Lambert grey(Rgb::Constant(0.5));
  SphereOptions small;
  small.size = 8;
  const json curves = json::parse(curves_json(grey, view("grey", grey, *table, small)));
  const json axes = json::parse(curve_axes_json());
  ASSERT_EQ(curves["lobes"].size(), axes["lobe_theta_i"].size());
  constexpr double kFourDigits = 5e-4;  // half a unit of the fourth, of a number that begins with 1
  for (const json& lobe : curves["lobes"]) {
    ASSERT_EQ(lobe.size(), axes["lobe_theta_o"].size());
    for (const double value : lobe) EXPECT_NEAR(value * std::numbers::pi / 0.5, 1, kFourDigits);
  }
  ASSERT_EQ(curves["albedo"].size(), 3U);
  for (const json& channel : curves["albedo"]) {
    ASSERT_EQ(channel.size(), axes["albedo_theta_o"].size());
    for (const double value : channel) EXPECT_NEAR(value, 0.5, kFourDigits);
  }
  for (const char* margin : {"theta_h", "phi_d"}) {
    double sum = 0;
    for (const double value : curves[margin]) sum += value;
    EXPECT_EQ(curves[margin].size(), axes[margin].size());
    EXPECT_NEAR(sum, 1, kFourDigits);
  }
  EXPECT_FALSE(curves.contains("live"));
}

std::shared_ptr<const RefinedBrdf> small_model() {
  const RefinedFitOptions options{.structure = {.components = 1, .half = 8, .difference = 6},
                                  .families = {families::find("frank")},
                                  .evaluations = 3};
  return fit_refined(builtin_material(), options).brdf;
}

TEST(CopulaDensities, AreDensities) {
  constexpr double kMidpoints = 0.02;  // of the rule over 24 x 24 squares
  const json copulas = json::parse(copula_densities_json(*small_model()));
  ASSERT_EQ(copulas.size(), 3U);
  for (const json& copula : copulas) {
    double sum = 0;
    for (const json& row : copula["density"]) {
      for (const double density : row) sum += density;
    }
    EXPECT_NEAR(sum / (24 * 24), 1, kMidpoints);
    EXPECT_EQ(copula["component"], 1);
    EXPECT_LT(std::abs(copula["tau"].get<double>()), 1);
  }
  EXPECT_EQ(copula_densities_json(Lambert(Rgb::Constant(0.5))), "[]");
}

TEST(CopulaDensities, OfAPairOfMoreCoordinatesAreReflectedAsItIs) {
  constexpr double kDigits = 2e-5;  // twice half a unit of the fifth
  const json pair = json::parse(pair_density_json(*families::find("clayton").make(2, {2}), 8));
  const json reflected = json::parse(pair_density_json(*families::find("clayton@u1").make(3, {2}), 8));
  for (std::size_t i = 0; i < 8; ++i) {
    for (std::size_t j = 0; j < 8; ++j) {
      EXPECT_NEAR(reflected[7 - i][j].get<double>() / pair[i][j].get<double>(), 1, kDigits) << i << ' ' << j;
    }
  }
}

TEST(LiveSphere, HoldsTheCodeOfTheModel) {
  const auto model = small_model();
  const json live = json::parse(live_sphere_json(*model));
  const ModelCode code = evaluation_code(*model);
  EXPECT_EQ(live["glsl"], code.text);
  EXPECT_EQ(live["values"].get<std::string>().size(), (4 * code.values.size() + 2) / 3 * 4);
  EXPECT_TRUE(live["picture"].get<std::string>().starts_with("data:image/png;base64,"));
  EXPECT_GT(live["exposure"], 0);
}

}  // namespace
}  // namespace sklar::brdf
