#include "copula/inference/model_io.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "copula/error.hpp"
#include "copula/file.hpp"
#include "copula/mixture.hpp"
#include "copula/rotated_family.hpp"
#include "tests/support/family_cases.hpp"
#include "tests/support/message.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sklar {
namespace {

/// Numbers that need all their digits, subnormals and a negative zero.
CopulaModel model_of(const test::FamilyCase& test_case) {
  CopulaModel model{.dim = test_case.dim, .components = {{.family = test_case.family->name, .theta = test_case.theta}}};
  for (double& value : model.components[0].theta) value = std::nextafter(value, 0.5);
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
    Theta& theta = model.components[0].theta;
    if (!test_case.family->admits(test_case.dim, theta)) theta = test_case.theta;
    const std::string json = to_json(model);
    const CopulaModel back = parse_model(json, "model.json", families::all());
    EXPECT_EQ(back.components.at(0).theta, theta);
    EXPECT_EQ(to_json(back), json);
    const Points x = uniforms(rng, 20, test_case.dim) * 2;
    const Column before = make_joint(model, families::all()).cdf(x);
    EXPECT_TRUE((make_joint(back, families::all()).cdf(x) == before).all()) << test_case.name();
  }
}

const std::string kMixture =
    R"({"format":"sklar copula","version":2,"dim":2,"components":[)"
    R"({"weight":0.25,"family":"clayton@90","theta":[2.0]},{"weight":0.75,"family":"frank","theta":[1.5]}],"margins":[]})"
    "\n";

TEST(ModelIo, WritesTheOldestVersionThatHoldsTheModel) {
  const std::string plain = R"({"format":"sklar copula","version":1,"family":"clayton","dim":2,"theta":[2.0],)"
                            R"("margins":[]})"
                            "\n";
  EXPECT_EQ(to_json({.dim = 2, .components = {{.family = "clayton", .theta = {2}}}}), plain);
  const std::string rotated = R"({"format":"sklar copula","version":2,"family":"clayton@180","dim":2,"theta":[2.0],)"
                              R"("margins":[]})"
                              "\n";
  EXPECT_EQ(to_json({.dim = 2, .components = {{.family = "clayton@180", .theta = {2}}}}), rotated);
  const CopulaModel mixture{.dim = 2,
                            .components = {{.family = "clayton@90", .theta = {2}, .weight = 0.25},
                                           {.family = "frank", .theta = {1.5}, .weight = 0.75}}};
  EXPECT_EQ(to_json(mixture), kMixture);
  for (const std::string& json : {plain, rotated, kMixture}) {
    EXPECT_EQ(to_json(parse_model(json, "model.json", families::all())), json);
  }
}

TEST(ModelIo, KeepsMarginsOfEveryKind) {
  const std::vector<std::pair<StoredMarginal, std::string>> cases = {
      {NormalMarginal(-1, 0.1), R"({"kind":"normal","mean":-1.0,"sd":0.1})"},
      {GammaMarginal(0.3, 2), R"({"kind":"gamma","shape":0.3,"scale":2.0})"},
      {BetaMarginal(1, 2, -3, 4), R"({"kind":"beta","a":1.0,"b":2.0,"lowest":-3.0,"highest":4.0})"},
      {KernelMarginal(Column{{3, 1}}, 0.1), R"({"kind":"kernel","values":[3.0,1.0],"bandwidth":0.1})"},
      {KernelMarginal(Column{{3, 1}}, 0.1, Column{{1, 2}}),
       R"({"kind":"kernel","values":[3.0,1.0],"bandwidth":0.1,"weights":[1.0,2.0]})"},
      {EmpiricalMarginal(Column{{3, 1}}, Column{{0.5, 2}}),
       R"({"kind":"empirical","values":[1.0,3.0],"weights":[2.0,0.5]})"}};
  for (const auto& [margin, text] : cases) {
    const std::string json = to_json({.dim = 2,
                                      .components = {{.family = "clayton", .theta = {2}}},
                                      .margins = {HistogramMarginal({0, 1}, {1}), margin}});
    EXPECT_EQ(json, R"({"format":"sklar copula","version":3,"family":"clayton","dim":2,"theta":[2.0],"margins":[)"
                    R"({"kind":"histogram","edges":[0.0,1.0],"masses":[1.0]},)" +
                        text + "]}\n");
    const CopulaModel back = parse_model(json, "model.json", families::all());
    EXPECT_EQ(to_json(back), json);
    EXPECT_GT(make_joint(back, families::all()).cdf(Points{{0.5, 2.0}})(0), 0);
  }
}

TEST(ModelIo, KeepsTheNamesOfColumns) {
  const CopulaModel model{
      .dim = 2, .components = {{.family = "clayton", .theta = {2}}}, .columns = {"loss", "a \"b\", c"}};
  const std::string json = to_json(model);
  EXPECT_EQ(json, R"({"format":"sklar copula","version":4,"family":"clayton","dim":2,"theta":[2.0],)"
                  R"("columns":["loss","a \"b\", c"],"margins":[]})"
                  "\n");
  EXPECT_EQ(parse_model(json, "model.json", families::all()).columns, model.columns);
  EXPECT_EQ(family_from_json(json, "m.json", families::all()).definition.find("columns"), std::string::npos)
      << "a family is of the copula alone";
}

TEST(ModelIo, RefusesColumnsThatTellNothing) {
  const auto refusal = [](const std::vector<std::string>& columns) {
    CopulaModel model{.dim = 2, .components = {{.family = "clayton", .theta = {2}}}, .columns = columns};
    return test::message_of<std::invalid_argument>([&] { (void)to_json(model); });
  };
  EXPECT_EQ(refusal({"a"}), "needs the names of 2 columns or none, got 1");
  EXPECT_EQ(refusal({"a", "a"}), "two columns are named 'a'");
  EXPECT_EQ(refusal({"a", "\xE4"}), "the name of a column is not UTF-8");
}

TEST(ModelIo, AMixtureIsThatOfItsComponents) {
  const CopulaPtr read = make_copula(parse_model(kMixture, "model.json", families::all()), families::all());
  const Mixture made({families::find("clayton@90").make(2, {2}), families::find("frank").make(2, {1.5})}, {0.25, 0.75});
  Rng rng(1);
  const Points u = uniforms(rng, 20, 2);
  EXPECT_TRUE((read->log_pdf(u) == made.log_pdf(u)).all());
  EXPECT_TRUE((read->h_inv(u) == made.h_inv(u)).all());
}

// A model of a model of a model, each with its definition, needs no list of families but the registered ones.
TEST(ModelIo, AModelIsAFamilyWithoutParameters) {
  const FamilyInfo family = family_from_json(kMixture, "mix.json", families::all());
  EXPECT_EQ(family.name, "mix.json");
  EXPECT_TRUE(family.parameters.empty() && std::isnan(family.tau({})));
  const double lower = families::find("clayton@90").tails({2}).lower;
  EXPECT_EQ(family.tails({}).lower, 0.25 * lower);
  EXPECT_THROW((void)family.make(3, {}), std::domain_error);
  const FamilyInfo turned = rotated_family(family, Rotation("270"));
  const CopulaModel model{.dim = 2,
                          .components = {{.family = turned.name, .theta = {}, .definition = turned.definition},
                                         {.family = "gumbel", .theta = {1.25}}}};
  CopulaModel even = model;
  for (ModelComponent& component : even.components) component.weight = 0.5;
  const std::string json = to_json(even);
  const CopulaModel back = parse_model(json, "model.json", families::all());
  EXPECT_EQ(to_json(back), json);
  EXPECT_EQ(back.components[0].family, "mix.json@270");
  const Points u = Points::Constant(1, 2, 0.3);
  const Mixture made({turned.make(2, {}), families::find("gumbel").make(2, {1.25})}, {0.5, 0.5});
  EXPECT_EQ(make_copula(back, families::all())->log_pdf(u)(0), made.log_pdf(u)(0));
}

TEST(ModelIo, MarginsAreOptional) {
  const test::FamilyCase test_case = test::family_cases({3}).front();
  const CopulaModel model{.dim = 3, .components = {{.family = test_case.family->name, .theta = test_case.theta}}};
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
  EXPECT_EQ(failure(R"({"format":"sklar copula","version":5})"),
            "model.json: has version 5; this program reads versions 1 to 4");
  EXPECT_EQ(failure(R"({"format":"sklar copula","version":"1"})"),
            "model.json: field 'version' must be a whole number in 0 to 1000000, found \"1\"");
  EXPECT_EQ(failure(R"({"format":"sklar copula","version":1})"), "model.json: field 'dim' is missing");
  EXPECT_EQ(failure(R"({"format":"sklar copula","version":1,"dim":2})"), "model.json: field 'family' is missing");
  EXPECT_EQ(failure(head + R"("dim":2,"theta":"x"})"), "model.json: field 'theta' must be an array of numbers");
  EXPECT_EQ(failure(head + R"("dim":2,"theta":[null]})"), "model.json: field 'theta' must be an array of numbers");
  EXPECT_EQ(failure(head + R"("dim":2,"theta":[0.5],"margins":[]})"),
            "model.json: " + name + ": takes 0 parameters, got 1");
  EXPECT_EQ(failure(head + R"("dim":1,"theta":[],"margins":[]})"),
            "model.json: " + name + ": dimension must be 2 or more, got 1");
  EXPECT_EQ(failure(head + R"("dim":2,"theta":[],"margins":[{"kind":"empirical","values":[1]}]})"),
            "model.json: needs 2 margins or none, got 1");
  EXPECT_EQ(
      failure(head + R"("dim":2,"theta":[],"margins":[{"kind":"spline"}]})"),
      "model.json: margins[0]: unknown kind 'spline'; known kinds: histogram, empirical, kernel, normal, gamma, beta");
  EXPECT_EQ(failure(head + R"("dim":2,"theta":[],"margins":[{"kind":"histogram","edges":[0,1],"masses":[-1]}]})"),
            "model.json: margins[0]: histogram: masses must be finite and 0 or more, got masses(0) = -1");
  EXPECT_EQ(failure(head + R"("dim":2,"theta":[],"columns":["a","a"],"margins":[]})"),
            "model.json: two columns are named 'a'");
  EXPECT_EQ(failure(head + R"("dim":2,"theta":[],"columns":["a",1],"margins":[]})"),
            "model.json: columns[1]: must be a text");
  EXPECT_EQ(failure(R"({"format":"sklar copula","version":1,"family":"x","dim":2,"theta":[],"margins":[]})"),
            "model.json: unknown family 'x'; known families: " + name);
}

TEST(ModelIo, RefusesNumbersBeyondDoubleAndWhatIsDeepOrWide) {
  const std::string head = R"({"format":"sklar copula","version":)";
  EXPECT_EQ(failure(head + "1e400}"), "model.json: holds a number that is beyond double");
  constexpr std::size_t kLevels = 300000;  // by as many calls of a function the stack is too small
  EXPECT_EQ(failure(head + std::string(kLevels, '[') + std::string(kLevels, ']') + "}"),
            "model.json: nests more than 64 levels");
  std::string fields = head + "1";
  for (int n = 0; n < 10000; ++n) fields += ",\"" + std::to_string(n) + "\":0";
  EXPECT_EQ(failure(fields + "}"), "model.json: has an object of more than 10000 fields");
  EXPECT_EQ(failure(head + R"(1,"dim":1001})"), "model.json: field 'dim' must be at most 1000, found 1001");
}

TEST(ModelIo, ModelsInModelsAreEachReadOnce) {
  std::string json = R"({"format":"sklar copula","version":1,"dim":2,"family":"frank","theta":[2],"margins":[]})";
  constexpr int kModels = 40;  // read twice by each around it, the innermost would be read 2^40 times
  for (int n = 0; n < kModels; ++n) {
    json.insert(0, R"({"format":"sklar copula","version":2,"dim":2,"theta":[],"margins":[],"family":)").append("}");
  }
  const CopulaModel model = parse_model(json, "model.json", families::all());
  const Points u = Points::Constant(1, 2, 0.3);
  EXPECT_EQ(make_copula(model, families::all())->log_pdf(u)(0), families::find("frank").make(2, {2})->log_pdf(u)(0));
}

TEST(ModelIo, NamesWhatIsWrongInAMixture) {
  const auto failure_of = [](const std::string& from, const std::string& to) {
    std::string json = kMixture;
    json.replace(json.find(from), from.size(), to);
    try {
      (void)parse_model(json, "model.json", families::all());
    } catch (const FileError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_EQ(failure_of("0.25", "0.5"), "model.json: the weights of a mixture must have the sum 1, got 1.25");
  EXPECT_EQ(failure_of("0.25", "-0.25"), "model.json: the weights of a mixture must be > 0, got -0.25");
  EXPECT_EQ(failure_of("\"weight\":0.25,", ""), "model.json: components[0]: field 'weight' is missing");
  EXPECT_EQ(failure_of("clayton@90", "clayton@45").substr(0, 57),
            "model.json: components[0]: unknown rotation '@45'; allowe");
  EXPECT_EQ(failure_of("frank", "x").substr(0, 67),
            "model.json: components[1]: unknown family 'x'; known families: inde");
  EXPECT_EQ(failure_of("\"dim\":2", "\"dim\":3"), "model.json: components[0]: clayton@90: dimension must be 2, got 3");
  EXPECT_EQ(failure_of("\"dim\"", "\"theta\":[],\"dim\""),
            "model.json: has the field 'components', so 'family' and 'theta' belong into its entries");
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
