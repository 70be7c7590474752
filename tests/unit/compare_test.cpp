#include "brdf/study/compare.hpp"

#include <gtest/gtest.h>

#include "brdf/analytic/lambert.hpp"
#include "brdf/analytic/synthetic.hpp"
#include "brdf/study/evaluation_time.hpp"
#include "brdf/study/results.hpp"
#include "families/registry.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sklar::brdf {
namespace {

using CompareTest = test::TemporaryFolder;

TEST_F(CompareTest, MeasuresFitsAndDraws) {
  const auto table = std::make_shared<const MeasuredTable>(builtin_material());
  const std::vector<const FamilyInfo*> families = {&families::find("independence")};
  const std::vector<FamilyFitOptions> modes = {
      PaperFitOptions{},
      RefinedFitOptions{.structure = {.components = 2, .half = 8, .difference = 6}, .evaluations = 20}};
  std::vector<std::string> said;
  const Comparison comparison =
      compare_families(table, families, modes, folder_, [&](const std::string& what) { said.push_back(what); });
  ASSERT_EQ(comparison.rows.size(), 2U);
  const CompareRow& row = comparison.rows[0];
  EXPECT_EQ(row.error, "");
  EXPECT_EQ(row.mode, "paper");
  EXPECT_EQ(comparison.rows[1].mode, "refined");
  EXPECT_LT(comparison.rows[1].bytes, row.bytes / 10);
  EXPECT_EQ(row.bytes, 4U * 3 * 6 * (90 + 15 + 180 + 1));
  EXPECT_GT(row.eval_ns, 0);
  EXPECT_GT(row.log1p_mae, 0);
  EXPECT_LT(row.log1p_mae, 0.05);
  EXPECT_GT(row.sphere_psnr_linear_db, 20);
  EXPECT_GT(row.albedo_max, 0.1);
  EXPECT_LT(row.albedo_max, 1.5);
  EXPECT_EQ(row.theta[2].size(), 6U);
  EXPECT_EQ(comparison.figures.size(), 4U);
  for (const auto& path : comparison.figures) EXPECT_GT(std::filesystem::file_size(path), 1000U) << path;
  EXPECT_FALSE(said.empty());
}

TEST(Results, NameEveryFigure) {
  CompareRow row{
      .material = "a,b", .provenance = Provenance::measured, .family = "frank", .bytes = 7, .log1p_mae = 0.5};
  row.theta[0] = {{1.5}, {}};
  row.theta[1] = {{2, 3}};
  row.error = "slice 1: \"bad\"";
  const std::vector<CompareRow> rows = {row};
  const std::string csv = to_csv(rows);
  EXPECT_EQ(csv.substr(0, csv.find('\n')),
            "material,provenance,model,family,mode,bytes,fit_s,eval_ns,log1p_mae,logrel_mae,cuberoot_rms,rel_l2,"
            "sphere_psnr_linear_db,albedo_max,theta,error");
  EXPECT_EQ(
      csv.substr(csv.find('\n') + 1),
      "\"a,b\",measured,copula,frank,paper,7,nan,nan,0.5,nan,nan,nan,nan,nan,1.5;|2 3|,\"slice 1: \"\"bad\"\"\"\n");
  const std::string json = to_json(rows);
  EXPECT_NE(json.find("\"log1p_mae\": 0.5"), std::string::npos) << json;
  EXPECT_NE(json.find("\"rel_l2\": null"), std::string::npos) << json;
  EXPECT_NE(to_markdown(rows).find("| a,b "), std::string::npos);
}

TEST(EvaluationTime, IsPositive) {
  EXPECT_GT(evaluation_ns(Lambert(Rgb::Constant(0.5))), 0);
}

}  // namespace
}  // namespace sklar::brdf
