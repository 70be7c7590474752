#include "brdf/study/model_comparison.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "brdf/analytic/lambert.hpp"
#include "brdf/analytic/registry.hpp"
#include "brdf/analytic/synthetic.hpp"
#include "brdf/basis/registry.hpp"
#include "brdf/model/model_io.hpp"
#include "brdf/study/model_batch.hpp"
#include "brdf/study/model_row.hpp"
#include "copula/error.hpp"
#include "copula/file.hpp"
#include "families/registry.hpp"
#include "tests/support/function_brdf.hpp"
#include "tests/support/refined_cases.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sklar::brdf {
namespace {

const std::vector<double> kBudgets = {1024, 4096};

class ModelComparisonTest : public test::TemporaryFolder {
 protected:
  const std::shared_ptr<const MeasuredTable> table_ = std::make_shared<const MeasuredTable>(builtin_material());
};

/// One that can be stored.
ModelPtr small_model() {
  const RefinedStructure structure = test::small_structure();
  const RefinedLayout layout(structure, {false, false});
  const std::vector<double> zeros(static_cast<std::size_t>(layout.size()), 0);
  const std::vector<FamilyInfo> families(2, families::find("independence"));
  return std::make_shared<const RefinedBrdf>(structure, families, pack(layout, 12, zeros));
}

Contender constant(const std::string& name, double albedo, int& fits) {
  return {.model = name, .kind = "analytic", .title = name, .source = "a test", .fit = [albedo, &fits](const auto&) {
            ++fits;
            return ContenderFit{std::make_shared<const Lambert>(Rgb::Constant(albedo)), 24, "as told", small_model()};
          }};
}

Contender unfit(const std::string& name, std::atomic<int>& fits) {
  return {.model = name, .kind = "basis", .title = name, .source = "a test", .fit = [&fits](const auto&) {
            ++fits;
            throw std::runtime_error("too little data");
            return ContenderFit{};
          }};
}

TEST_F(ModelComparisonTest, JudgesKeepsAndGoesOn) {
  int fits = 0;
  std::vector<Contender> contenders = {constant("grey", 0.2, fits)};
  (void)compare_models({.table = table_, .others = {}}, contenders, folder_);
  contenders.push_back(constant("white", 1, fits));
  std::atomic<int> unfits = 0;
  contenders.push_back(unfit("none", unfits));
  std::vector<std::string> said;
  const ModelComparison comparison = compare_models({.table = table_, .others = {}}, contenders, folder_,
                                                    [&](const std::string& what) { said.push_back(what); });
  EXPECT_EQ(fits, 2);  // grey was there already
  EXPECT_EQ(said.size(), 3U);
  ASSERT_EQ(comparison.rows.size(), 3U);
  const ModelRow &grey = comparison.rows[0], &white = comparison.rows[1], &none = comparison.rows[2];
  EXPECT_EQ(grey.bytes, 24);
  EXPECT_EQ(grey.note, "as told");
  EXPECT_LT(grey.log1p_mae, white.log1p_mae);
  EXPECT_GT(grey.sphere_psnr_linear_db, white.sphere_psnr_linear_db);
  EXPECT_GT(grey.ssim, white.ssim);
  EXPECT_LT(grey.delta_e_2000, white.delta_e_2000);
  EXPECT_NEAR(white.albedo_max, 1, 1e-9);
  EXPECT_NEAR(white.sampling_efficiency, 1, 1e-9);  // the cosine hemisphere is Lambert's own
  EXPECT_EQ(white.reciprocity_error, 0);
  EXPECT_EQ(none.error, "too little data");
  EXPECT_TRUE(std::isnan(none.log1p_mae));
  EXPECT_TRUE(comparison.spheres[2].rgb.empty());
  ASSERT_EQ(comparison.curves.size(), 3U);
  EXPECT_NE(comparison.curves[0], comparison.curves[1]);
  EXPECT_NE(comparison.reference_curves, "");
  EXPECT_EQ(comparison.curves[2], "");
  EXPECT_EQ(comparison.spheres[0].width, comparison.reference.width);
  EXPECT_EQ(read_brdf(folder_ / table_->name / "grey.model.json").brdf()->bytes(),
            std::visit([](const auto& model) { return model->bytes(); }, small_model()));
  EXPECT_FALSE(std::filesystem::exists(folder_ / table_->name / "none.model.json"));
  const auto sheet = write_model_sheet(comparison, folder_);
  EXPECT_GT(std::filesystem::file_size(sheet), 1000U);
}

TEST_F(ModelComparisonTest, NamesADamagedRow) {
  int fits = 0;
  const std::vector<Contender> contenders = {constant("grey", 0.2, fits)};
  std::filesystem::create_directory(folder_ / table_->name);
  write_file(folder_ / table_->name / "grey.json", "{\"format\": \"sklar-model-comparison\", \"version\": 1}");
  try {
    (void)compare_models({.table = table_, .others = {}}, contenders, folder_);
    FAIL() << "no exception";
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find("grey.json"), std::string::npos) << error.what();
  }
  EXPECT_EQ(fits, 0);
}

TEST_F(ModelComparisonTest, ABatchDoesEachJobOnceFromTheSameInputs) {
  std::atomic<int> fits = 0;
  const std::vector<Contender> contenders = {unfit("one", fits), unfit("two", fits)};
  std::vector<std::string> inputs = {"first", "second"};
  std::vector<BatchMaterial> materials;
  for (std::size_t n = 0; n < 2; ++n) {
    materials.push_back({.name = "material_" + inputs[n],
                         .inputs = [&inputs, n] { return inputs[n]; },
                         .load = [this] { return table_; }});
  }
  std::vector<std::string> told;
  BatchOptions options{.progress = [&](const BatchState& state, const std::string& job) {
    EXPECT_EQ(state.jobs, 4U);
    told.push_back(job);
  }};
  const std::vector<ModelRow> rows = fit_batch(materials, contenders, folder_, options);
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[3].error, "too little data");
  EXPECT_EQ(rows[3].inputs, "second");
  EXPECT_EQ(std::set<std::string>(told.begin(), told.end()).size(), 4U);
  EXPECT_EQ(fit_batch(materials, contenders, folder_, options)[2].model, "one");
  EXPECT_EQ(fits, 4) << "a job that has failed is done";
  inputs[1] = "changed";
  EXPECT_EQ(fit_batch(materials, contenders, folder_, options)[3].inputs, "changed");
  EXPECT_EQ(fits, 6);
  options.retry_failed = true;
  (void)fit_batch(materials, contenders, folder_, options);
  EXPECT_EQ(fits, 10);
  options.progress = [](const BatchState&, const std::string&) { throw std::runtime_error("enough"); };
  EXPECT_THROW((void)fit_batch(materials, contenders, folder_, options), std::runtime_error);
  EXPECT_EQ(fits, 10);
}

TEST(ReciprocityErrorOfModels, IsTheRelativeDifference) {
  EXPECT_EQ(reciprocity_error(Lambert(Rgb(0.1, 0.5, 0))), 0);
  EXPECT_EQ(reciprocity_error(Lambert(Rgb::Zero())), 0);
  // f = wo_z: the mean of |x - y| over that of x, for uniform x and y, is 2/3.
  const test::FunctionBrdf by_wo([](const Vec3& wo, const Vec3&) { return Rgb::Constant(wo.z()); });
  EXPECT_NEAR(reciprocity_error(by_wo), 2.0 / 3, 0.02);
}

TEST(ModelRowFile, GivesTheRowBack) {
  ModelRow row{.material = "felt \"green\"", .provenance = Provenance::measured, .kind = "basis", .model = "nmf"};
  row.budget = 4096;
  row.log1p_mae = 0.1 + 0.2;
  row.sphere_psnr_linear_db = HUGE_VAL;
  row.note = "a, b";
  row.inputs = "a file";
  const ModelRow back = model_row_from_json(to_json(row), "row");
  EXPECT_EQ(to_json(back), to_json(row));
  EXPECT_EQ(back.log1p_mae, 0.1 + 0.2);
  EXPECT_EQ(back.sphere_psnr_linear_db, HUGE_VAL);
  EXPECT_TRUE(std::isnan(back.ssim));
  EXPECT_EQ(back.provenance, Provenance::measured);
  EXPECT_THROW((void)model_row_from_json("{}", "row"), FileError);
}

TEST(ModelTables, RankWithinAMaterialAndAverageOverThem) {
  const auto row = [](const char* material, const char* model, double error) {
    ModelRow result{.material = material, .kind = "analytic", .model = model};
    result.bytes = 8;
    for (double ModelRow::*lower : {&ModelRow::log1p_mae, &ModelRow::logrel_mae, &ModelRow::cuberoot_rms,
                                    &ModelRow::rel_l2, &ModelRow::delta_e_2000}) {
      result.*lower = error;
    }
    for (double ModelRow::*higher : {&ModelRow::sphere_psnr_linear_db, &ModelRow::psnr_gamma_db, &ModelRow::ssim}) {
      result.*higher = -error;
    }
    return result;
  };
  std::vector<ModelRow> rows = {row("a", "good", 1), row("a", "bad", 2), row("b", "good", 5), row("b", "bad", 4),
                                row("b", "best", 3)};
  rows.push_back({.material = "a", .kind = "basis", .model = "broken", .error = "no, none"});
  const std::string summary = summary_markdown(rows);
  // Of a: good 1, bad 2; of b: best 1, bad 2, good 3.
  EXPECT_LT(summary.find("| best | 1 | 1.0 |"), summary.find("| bad | 2 | 2.0 |")) << summary;
  EXPECT_NE(summary.find("| good | 2 | 2.0 |"), std::string::npos) << summary;
  EXPECT_EQ(summary.find("broken"), std::string::npos);
  const std::string csv = to_csv(rows);
  EXPECT_NE(csv.find("\"no, none\""), std::string::npos);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 7);
  EXPECT_NE(to_markdown(rows).find("| a | analytic | good | 8 |"), std::string::npos) << to_markdown(rows);
  EXPECT_NE(to_json(rows).find("\"model\": \"broken\""), std::string::npos);
}

TEST(ModelTables, HaveARankForEachMeasure) {
  const auto row = [](const char* material, const char* model, double log1p_mae, double ssim) {
    ModelRow result{.material = material, .kind = "analytic", .model = model};
    result.log1p_mae = log1p_mae;
    result.ssim = ssim;
    return result;
  };
  // Of a: least error and least ssim are not those of one model, and two share an ssim; b is ranked by itself.
  std::vector<ModelRow> rows = {row("a", "x", 1, 0.5), row("a", "y", 3, 0.9), row("a", "z", 2, 0.9),
                                row("b", "x", 9, 0.1)};
  rows.push_back({.material = "a", .kind = "basis", .model = "broken", .error = "none"});
  const auto document = nlohmann::json::parse(to_json(rows));
  const std::vector<double> by_error = {1, 3, 2, 1}, by_ssim = {3, 1.5, 1.5, 1};
  for (std::size_t n = 0; n < 4; ++n) {
    EXPECT_EQ(document["rows"][n]["rank_log1p_mae"], by_error[n]) << n;
    EXPECT_EQ(document["rows"][n]["rank_ssim"], by_ssim[n]) << n;
  }
  EXPECT_EQ(document["rows"][4]["rank_log1p_mae"], "nan");
  EXPECT_FALSE(document["rows"][0].contains("rank_bytes"));
  const std::string csv = to_csv(rows);
  EXPECT_NE(csv.find(",rank_log1p_mae,rank_logrel_mae,rank_cuberoot_rms,rank_rel_l2,rank_sphere_psnr_linear_db,"
                     "rank_psnr_gamma_db,rank_ssim,rank_delta_e_2000,note,error\n"),
            std::string::npos)
      << csv;
  const std::string second = csv.substr(csv.find("a,unknown,analytic,y"));
  const std::string line = second.substr(0, second.find('\n'));
  EXPECT_TRUE(line.ends_with(",3,nan,nan,nan,nan,nan,1.5,nan,,")) << line;
  EXPECT_EQ(to_json(rows[0]).find("rank"), std::string::npos) << "a row by itself has none";
}

TEST(Contenders, AreEveryModelOnce) {
  std::set<std::string> names, models;
  for (const Contender& contender : all_contenders(kBudgets)) {
    EXPECT_TRUE(names.insert(contender.name()).second) << contender.name();
    EXPECT_FALSE(contender.title.empty() || contender.source.empty()) << contender.name();
    models.insert(contender.model);
  }
  for (const AnalyticInfo& info : analytic::all()) {
    EXPECT_EQ(models.contains(info.name), info.isotropic_form.empty()) << info.name;
  }
  for (const BasisInfo& info : basis::all()) EXPECT_TRUE(models.contains(info.name)) << info.name;
  for (const char* name : {"refined-1024", "refined-4096", "paper", "nmf-1024", "ggx", "table"}) {
    EXPECT_TRUE(names.contains(name)) << name;
  }
}

TEST(Contenders, AreFoundByName) {
  const std::vector<std::string> names = {"nmf", "lambert"};
  const std::vector<Contender> found = find_contenders(names, kBudgets);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[1].name(), "nmf-4096");
  EXPECT_EQ(found[2].name(), "lambert");
  const std::vector<std::string> left_out = {"ggx_anisotropic"};
  EXPECT_EQ(find_contenders(left_out, kBudgets).size(), 1U) << "is fitted where it is asked for";
  const std::vector<std::string> unknown = {"shiny"};
  try {
    (void)find_contenders(unknown, kBudgets);
    FAIL() << "no exception";
  } catch (const std::invalid_argument& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("'shiny'"), std::string::npos) << message;
    for (const char* known : {"all", "refined", "ggx_diffuse", "zernike"}) {
      EXPECT_NE(message.find(known), std::string::npos) << message;
    }
  }
  EXPECT_THROW((void)all_contenders({}), std::invalid_argument);
  const std::vector<double> bad = {0};
  EXPECT_THROW((void)all_contenders(bad), std::invalid_argument);
}

// What is told apart only by its sampler: the refined model comes with one made for it, whose bytes do not count.
TEST_F(ModelComparisonTest, FitsEachKind) {
  const std::vector<std::string> names = {"ward", "separable_svd"};
  const std::vector<double> budget = {1024};
  for (const Contender& contender : find_contenders(names, budget)) {
    const ContenderFit fit = contender.fit({.table = table_, .others = {}});
    EXPECT_EQ(fit.bytes, fit.brdf->bytes());
    EXPECT_LE(fit.bytes, 1024U);
  }
}

}  // namespace
}  // namespace sklar::brdf
