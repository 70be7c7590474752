#include "copula/inference/model_io.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "copula/error.hpp"
#include "copula/file.hpp"
#include "tests/support/family_cases.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sklar {
namespace {

/// Numbers that need all their digits, subnormals and a negative zero.
CopulaModel model_of(const test::FamilyCase& test_case) {
  CopulaModel model{.family = test_case.family->name, .dim = test_case.dim, .theta = test_case.theta, .margins = {}};
  for (double& value : model.theta) value = std::nextafter(value, 0.5);
  for (int i = 1; i < test_case.dim; ++i) {
    model.margins.emplace_back(HistogramMarginal({-0.0, 0.1, 1.0 / 3, 2}, {5e-324, 0.7, 1.0 / (2 + i)}));
  }
  model.margins.emplace_back(EmpiricalMarginal(Column{{0.1, -1e300, 4e-310, M_PI}}));
  return model;
}

TEST(ModelIo, IsBitForBitAfterARoundTrip) {
  Rng rng(1);
  for (const test::FamilyCase& test_case : test::family_cases({2, 3})) {
    CopulaModel model = model_of(test_case);
    if (!test_case.family->admits(test_case.dim, model.theta)) model.theta = test_case.theta;
    const std::string json = to_json(model);
    const CopulaModel back = parse_model(json, "model.json", families::all());
    EXPECT_EQ(back.theta, model.theta);
    EXPECT_EQ(to_json(back), json);
    const Points x = uniforms(rng, 20, test_case.dim) * 2;
    const Column before = make_joint(model, families::all()).cdf(x);
    EXPECT_TRUE((make_joint(back, families::all()).cdf(x) == before).all()) << test_case.name();
  }
}

TEST(ModelIo, MarginsAreOptional) {
  const test::FamilyCase test_case = test::family_cases({3}).front();
  const CopulaModel model{.family = test_case.family->name, .dim = 3, .theta = test_case.theta, .margins = {}};
  const CopulaModel back = parse_model(to_json(model), "model.json", families::all());
  EXPECT_EQ(make_copula(back, families::all())->dim(), 3);
  EXPECT_THROW((void)make_joint(back, families::all()), std::invalid_argument);
}

std::string failure(const std::string& json) {
  try {
    (void)parse_model(json, "model.json", families::all().first(1));
  } catch (const FileError& error) {
    return error.what();
  }
  return "no error";
}

TEST(ModelIo, NamesWhatIsWrong) {
  const std::string name = families::all().front().name;
  ASSERT_TRUE(families::all().front().parameters.empty());
  const std::string head = R"({"format":"sklar copula","version":1,"family":")" + name + R"(",)";
  EXPECT_EQ(failure(""), "model.json: is not valid JSON: byte 1");
  EXPECT_EQ(failure(head), "model.json: is not valid JSON: byte " + std::to_string(head.size() + 1));
  EXPECT_EQ(failure("{}"), R"(model.json: expected "format": "sklar copula")");
  EXPECT_EQ(failure(R"({"format":"sklar copula","version":2})"),
            "model.json: has version 2; this program reads versions 1 to 1");
  EXPECT_EQ(failure(R"({"format":"sklar copula","version":"1"})"),
            "model.json: field 'version' must be a whole number in 0 to 1000000, found \"1\"");
  EXPECT_EQ(failure(R"({"format":"sklar copula","version":1})"), "model.json: field 'family' is missing");
  EXPECT_EQ(failure(head + R"("dim":2,"theta":"x"})"), "model.json: field 'theta' must be an array of numbers");
  EXPECT_EQ(failure(head + R"("dim":2,"theta":[null]})"), "model.json: field 'theta' must be an array of numbers");
  EXPECT_EQ(failure(head + R"("dim":2,"theta":[0.5],"margins":[]})"),
            "model.json: " + name + ": takes 0 parameters, got 1");
  EXPECT_EQ(failure(head + R"("dim":1,"theta":[],"margins":[]})"),
            "model.json: " + name + ": dimension must be 2 or more, got 1");
  EXPECT_EQ(failure(head + R"("dim":2,"theta":[],"margins":[{"kind":"empirical","values":[1]}]})"),
            "model.json: needs 2 margins or none, got 1");
  EXPECT_EQ(failure(head + R"("dim":2,"theta":[],"margins":[{"kind":"spline"}]})"),
            "model.json: margins[0]: unknown kind 'spline'; known kinds: histogram, empirical");
  EXPECT_EQ(failure(head + R"("dim":2,"theta":[],"margins":[{"kind":"histogram","edges":[0,1],"masses":[-1]}]})"),
            "model.json: margins[0]: histogram: masses must be finite and 0 or more, got masses(0) = -1");
  EXPECT_EQ(failure(R"({"format":"sklar copula","version":1,"family":"x","dim":2,"theta":[],"margins":[]})"),
            "model.json: unknown family 'x'; known families: " + name);
}

class ModelFile : public test::TemporaryFolder {};

TEST_F(ModelFile, IsReadFromAFile) {
  const CopulaModel model = model_of(test::family_cases({2}).front());
  write_file(folder_ / "m.json", to_json(model));
  EXPECT_EQ(to_json(read_model(folder_ / "m.json", families::all())), to_json(model));
  EXPECT_THROW((void)read_model(folder_ / "missing.json", families::all()), FileError);
}

}  // namespace
}  // namespace sklar
