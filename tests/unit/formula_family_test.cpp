/// Families given as JSON files: what the files may hold, and the examples from definition to fit.

#include "copula/symbolic/formula_family.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numeric>

#include "copula/error.hpp"
#include "copula/file.hpp"
#include "copula/inference/fit.hpp"
#include "copula/inference/model_io.hpp"
#include "copula/symbolic/generator_formula.hpp"
#include "families/registry.hpp"
#include "tests/support/chi_square.hpp"

namespace sklar::symbolic {
namespace {

std::string path_of(const std::string& name) {
  return std::string(SKLAR_EXAMPLE_FAMILIES) + "/" + name + ".json";
}

const FamilyInfo& example(const std::string& name) {
  return families::resolve(path_of(name));
}

const std::vector<std::string> kExamples{"inverse_gaussian", "bb1", "nelsen_4_2_12"};

std::string error_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "no error";
}

/// A definition in which one piece of the text is replaced.
std::string changed(const std::string& from, const std::string& to) {
  std::string text = R"json({"format": "sklar family", "version": 1, "name": "mine", "title": "Mine",
    "psi": "(1+theta*t)^(-1/theta)", "psi_inverse": "(u^(-theta)-1)/theta", "source": "none",
    "parameters": [{"name": "theta", "lowest": 0, "lowest_included": false, "highest": "inf"}],
    "examples": [[1], [5]]})json";
  const std::size_t place = text.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  return text.replace(place, from.size(), to);
}

std::string refusal(const std::string& from, const std::string& to) {
  return error_of([&] { (void)families::from_definition(changed(from, to), "mine.json"); });
}

TEST(FamilyDefinition, RefusesWhatIsNoDefinition) {
  EXPECT_EQ(refusal("{", ""), "mine.json: is not valid JSON: byte 9");
  EXPECT_EQ(refusal("sklar family", "other"), "mine.json: expected \"format\": \"sklar family\"");
  EXPECT_EQ(refusal("\"version\": 1", "\"version\": 2"),
            "mine.json: has version 2; this program reads versions 1 to 1");
  EXPECT_EQ(refusal("\"psi\":", "\"phi\":"),
            "mine.json: unknown field 'phi'; allowed are format, version, name, title, psi, psi_inverse, source, "
            "parameters, examples");
  EXPECT_EQ(refusal("\"title\": \"Mine\",", ""), "mine.json: field 'title' is missing");
  EXPECT_EQ(refusal("\"lowest_included\": false", "\"lowest_included\": 0"),
            "mine.json: parameters[0]: field 'lowest_included' must be true or false, found 0");
  EXPECT_EQ(refusal("[[1], [5]]", "[[1], 5]"), "mine.json: examples[1]: must be an array of numbers");
}

TEST(FamilyDefinition, RefusesAParameterWithoutBounds) {
  EXPECT_EQ(refusal(", \"highest\": \"inf\"", ""),
            "mine.json: parameters[0]: unbounded parameter 'theta': field 'highest' is missing; write a number, "
            "\"inf\", \"-inf\" or a formula in the dimension d such as \"-1/(d-1)\"");
  EXPECT_EQ(refusal("\"inf\"", "null"),
            "mine.json: parameters[0]: field 'highest' must be a number, \"inf\", \"-inf\" or a formula in d, found "
            "null");
}

TEST(FamilyDefinition, RefusesBadNames) {
  EXPECT_EQ(refusal("\"mine\"", "\"frank\""),
            "mine.json: field 'name': 'frank' is a registered family; choose another name");
  EXPECT_EQ(
      refusal("\"mine\"", "\"My family\""),
      "mine.json: field 'name': must be of lower-case letters, digits, - and _, and not 'all', found 'My family'");
  EXPECT_EQ(refusal("\"theta\"", "\"d\""),
            "mine.json: field 'parameters[0].name': must be a symbol of its own, and not t, u or d, found 'd'");
}

TEST(FamilyDefinition, ShowsWhereAFormulaIsWrong) {
  EXPECT_EQ(refusal("(1+theta*t)^", "(1+theta*t^"),
            "mine.json: field 'psi': ')' was expected, got the end at position 22\n"
            "  (1+theta*t^(-1/theta)\n"
            "                       ^");
  EXPECT_EQ(refusal("(1+theta*t)", "(1+alpha*t)"),
            "mine.json: field 'psi': unknown symbol 'alpha'; allowed are t, theta at position 4\n"
            "  (1+alpha*t)^(-1/theta)\n"
            "     ^");
  EXPECT_TRUE(
      refusal("u^(", "t^(")
          .starts_with("mine.json: field 'psi_inverse': unknown symbol 't'; allowed are u, theta at position 2\n"));
  EXPECT_TRUE(refusal("\"lowest\": 0", "\"lowest\": \"-1/(n-1)\"")
                  .starts_with("mine.json: field 'parameters[0].lowest': unknown symbol 'n'; allowed are d"));
  EXPECT_EQ(refusal("(1+theta*t)^(-1/theta)", "theta"), "mine.json: field 'psi': must depend on t");
}

TEST(FamilyDefinition, RefusesExamplesOutsideTheBounds) {
  EXPECT_EQ(refusal("[5]", "[-5]"), "mine.json: examples[1]: mine: theta must be in (0, inf) in dimension 2, got -5");
  EXPECT_EQ(refusal("[5]", "[5, 6]"), "mine.json: examples[1]: mine: takes 1 parameters, got 2");
}

TEST(FamilyDefinition, SurvivesTheRoundTrip) {
  for (const std::string& name : kExamples) {
    const FamilyDefinition definition = parse_definition(read_file(path_of(name)), name);
    EXPECT_EQ(to_json(parse_definition(to_json(definition), name)), to_json(definition));
    EXPECT_EQ(example(name).definition, to_json(definition));
  }
  const FamilyDefinition bounds = parse_definition(changed("\"lowest\": 0", "\"lowest\": \"-1/(d-1)\""), "");
  EXPECT_NE(to_json(bounds).find(R"json("lowest":"-1/(d-1)","highest":"inf","lowest_included":false)json"),
            std::string::npos)
      << to_json(bounds);
}

TEST(FormulaFamily, BoundsFollowTheDimension) {
  const FamilyInfo family = families::from_definition(
      changed("\"lowest\": 0, \"lowest_included\": false", "\"lowest\": \"-1/(d-1)\""), "mine.json");
  EXPECT_EQ(family.parameters[0].domain(2).lowest, -1);
  EXPECT_EQ(family.parameters[0].domain(3).lowest, -0.5);
  // -1/3 is no double: the nearest inside the domain.
  const double third = family.parameters[0].domain(4).lowest;
  EXPECT_LT(std::fma(third, 3.0, 1.0), 1e-15);
  EXPECT_GE(std::fma(third, 3.0, 1.0), 0);
  EXPECT_EQ(error_of([&] { (void)family.make(4, {-0.4}); }),
            "mine: theta must be in [-0.3333333333333333, inf) in dimension 4, got -0.4");
}

TEST(FormulaFamily, RefusesWhatIsNoGenerator) {
  const FamilyInfo family =
      families::from_definition(changed("\"lowest\": 0", "\"lowest\": -1"), "mine.json");  // too low for d > 2
  EXPECT_TRUE(
      error_of([&] { (void)family.make(4, {-0.45}); })
          .starts_with("mine (theta = -0.45): psi is no generator in dimension 4: (-1)^4 psi^(4)(t) must not be "
                       "negative, found psi^(4)("));
  EXPECT_EQ(error_of([&] { (void)family.make(kMaxDimension + 1, {1}); }), "mine: dimension must be 2 to 20, got 21");
}

TEST(FormulaFamily, RefusesAnInverseThatIsNone) {
  const std::string message = refusal("(u^(-theta)-1)/theta", "u^(-theta)-1");
  EXPECT_TRUE(message.starts_with("mine.json: mine (theta = ")) << message;
  EXPECT_NE(message.find("): psi_inverse is not the inverse of psi: psi(psi_inverse(0.5)) = "), std::string::npos);
}

/// By mpmath 1.2.1 with 1500 digits, derivatives by differences: log c(u), h(u), 1 - h(u).
struct Published {
  std::string family;
  Theta theta;
  std::vector<double> u;
  double log_pdf, h, h_upper;
};
const std::vector<Published> kPublished{
    {"inverse_gaussian", {2.0}, {0.25, 0.75}, -0.37191903375711578095, 0.86477718111730399665, 0.13522281888269600335},
    {"inverse_gaussian",
     {0.5},
     {1e-100, 1 - 1e-14, 0.5},
     -8.5129021666216698433,
     0.99296149864979643732,
     0.0070385013502035626815},
    {"inverse_gaussian",
     {20.0},
     {0.1, 1e-12, 0.3, 0.5, 0.9},
     -9.8656022196817151369,
     0.99955239617917225778,
     0.00044760382082774222253},
    {"bb1", {0.5, 1.5}, {0.25, 0.75}, -0.62535741794526387791, 0.92372759165473500311, 0.076272408345264996888},
    {"bb1", {2.0, 2.0}, {1e-100, 1 - 1e-14, 0.5}, -1866.6272017939051277, 1.0, 0.0},
    {"bb1",
     {0.1, 1.25},
     {0.1, 1e-12, 0.3, 0.5, 0.9},
     -10.710094601512027366,
     0.99869640343471283543,
     0.001303596565287164569},
    {"nelsen_4_2_12", {1.5}, {0.25, 0.75}, -1.009172689207614077, 0.95256211326833623781, 0.047437886731663762189},
    {"nelsen_4_2_12", {5.0}, {1e-100, 1 - 1e-14, 0.5}, -2425.957107488286653, 1.0, 0.0},
    {"nelsen_4_2_12", {2.5}, {0.1, 1e-12, 0.3, 0.5, 0.9}, -258.8466493076027642, 1.0, 1.8106995884813398718e-32},
};

TEST(FormulaFamily, ExamplesHaveThePublishedValues) {
  constexpr double kRelative = 1e-12;
  for (const Published& p : kPublished) {
    const int dim = static_cast<int>(p.u.size());
    const CopulaPtr copula = example(p.family).make(dim, p.theta);
    Points u = Eigen::Map<const Eigen::ArrayXd>(p.u.data(), dim).transpose();
    EXPECT_NEAR(copula->log_pdf(u)(0), p.log_pdf, kRelative * std::max(1.0, std::abs(p.log_pdf))) << p.family;
    EXPECT_NEAR(copula->h(u)(0), p.h, kRelative * p.h) << p.family;
    EXPECT_NEAR(copula->h_upper(u)(0), p.h_upper, kRelative * p.h_upper) << p.family;
    if (p.h < 0.999) {
      u(dim - 1) = p.h;
      EXPECT_NEAR(copula->h_inv(u)(0), p.u.back(), 10 * kRelative * p.u.back()) << p.family;
    }
    u(dim - 1) = p.h_upper;
    EXPECT_GE(copula->h_inv_upper(u)(0), 0);
  }
}

/// Whether two values are the same, of log densities absolute below 1.
bool agree(double found, double expected, double tolerance, bool logarithm) {
  const double size = logarithm ? std::max(1.0, std::abs(expected)) : std::abs(expected);
  return found == expected || std::abs(found - expected) <= tolerance * size;
}

void expect_same(const Copula& formula, const Copula& registered, const Points& u, bool near_independence) {
  constexpr double kTwice = 2e-13, kInverseTwice = 8e-13;
  const auto expect = [&](const char* quantity, double found, double expected, double tolerance, bool logarithm) {
    EXPECT_TRUE(agree(found, expected, tolerance, logarithm))
        << quantity << " (" << u << "): " << found << ", expected " << expected;
  };
  if (!near_independence) expect("log_pdf", formula.log_pdf(u)(0), registered.log_pdf(u)(0), kTwice, true);
  expect("h", formula.h(u)(0), registered.h(u)(0), kTwice, false);
  expect("h_upper", formula.h_upper(u)(0), registered.h_upper(u)(0), kTwice, false);
  expect("h_inv", formula.h_inv(u)(0), registered.h_inv(u)(0), kInverseTwice, false);
  expect("h_inv_upper", formula.h_inv_upper(u)(0), registered.h_inv_upper(u)(0), kInverseTwice, false);
}

TEST(FormulaFamily, ZerosGiveTheLimitsOfTheRegisteredFamilies) {
  const Points pairs{{0, 0.3}, {0, 0.999}, {0.3, 0}, {0, 0}};
  const Points triples{{0, 0.3, 0.8}, {0.3, 0, 0.6}, {0, 0, 0.8}, {0, 0, 0}};
  for (const FamilyInfo& family : families::all()) {
    const FamilyInfo formula = formula_of(family);
    for (const Points& points : {pairs, triples}) {
      const int dim = static_cast<int>(points.cols());
      for (const Theta& theta : family.examples) {
        if (!theta.empty() && !family.parameters[0].domain(dim).contains(theta[0])) continue;
        SCOPED_TRACE(family.name + " " + (theta.empty() ? "" : to_text(theta[0])));
        // Gumbel's density falls to 0 like (-log u)^(1 - theta), which does not show for theta = 1.001.
        const bool slow = family.name == "gumbel" && theta[0] > 1 && theta[0] < 1.1;
        const CopulaPtr copula = formula.make(dim, theta), expected = family.make(dim, theta);
        for (Index i = 0; i < points.rows(); ++i) expect_same(*copula, *expected, points.row(i), slow);
      }
    }
  }
}

TEST(FormulaFamily, ZerosOfFamiliesWithScalesOfTheirOwn) {
  // psi of t / theta: the copula of 1 / (1 + t), Clayton's with theta = 1.
  const FamilyInfo scaled =
      families::from_definition(changed("(1+theta*t)^(-1/theta)\", \"psi_inverse\": \"(u^(-theta)-1)/theta",
                                        "1/(1+t/theta)\", \"psi_inverse\": \"(1/u-1)*theta"),
                                "mine.json");
  const CopulaPtr clayton = families::find("clayton").make(2, {1});
  for (const double scale : {1e-30, 1.0, 1e30}) {
    for (const Points& u : {Points{{0, 0.3}}, Points{{0, 0}}}) {
      expect_same(*scaled.make(2, {scale}), *clayton, u, false);
    }
  }
}

// Beyond a bounded support psi is 0: densities are 0, and the next coordinate is 1.
TEST(FormulaFamily, GivenValuesBeyondTheSupport) {
  const CopulaPtr formula = formula_of(families::find("clayton")).make(3, {-0.45});
  const CopulaPtr registered = families::find("clayton").make(3, {-0.45});
  for (const Points& u : {Points{{0.01, 0.02, 0.6}}, Points{{0, 0.5, 0.6}}, Points{{0, 0, 0.6}}}) {
    expect_same(*formula, *registered, u, false);
  }
}

TEST(FormulaFamily, ExamplesHaveTheirTauAndTails) {
  constexpr double kTau = 1e-10;
  // Inverse Gaussian: by mpmath 1.2.1, quadrature in 40 digits.
  const std::vector<std::pair<double, double>> inverse_gaussian{{0.01, 0.0049264635871324848275},
                                                                {0.5, 0.15076519920844666482},
                                                                {2.0, 0.29817368116159703717},
                                                                {20.0, 0.4600732127235422584}};
  for (const auto& [theta, tau] : inverse_gaussian) {
    EXPECT_NEAR(example("inverse_gaussian").tau({theta}), tau, kTau);
    EXPECT_NEAR(example("inverse_gaussian").theta_from_tau(tau)[0], theta, 1e-8 * theta);
  }
  EXPECT_EQ(example("inverse_gaussian").tau_range(3).to_text(), "(0, 0.5)");
  // Joe (1997), sec. 5.2: tau, lambda_L and lambda_U of BB1.
  const TailDependence bb1 = example("bb1").tails({0.5, 1.5});
  EXPECT_NEAR(example("bb1").tau({0.5, 1.5}), 1 - 2 / (1.5 * 2.5), kTau);
  EXPECT_NEAR(bb1.lower, std::exp2(-1 / (0.5 * 1.5)), kTau);
  EXPECT_NEAR(bb1.upper, 2 - std::exp2(1 / 1.5), kTau);
  EXPECT_FALSE(example("bb1").theta_from_tau);
  // Nelsen (2006), example 5.4 with eq. 4.2.12: tau = 1 - 2 / (3 theta).
  for (const double theta : {1.0, 1.2, 5.0, 50.0}) {
    EXPECT_NEAR(example("nelsen_4_2_12").tau({theta}), 1 - 2 / (3 * theta), kTau);
    EXPECT_NEAR(example("nelsen_4_2_12").theta_from_tau(1 - 2 / (3 * theta))[0], theta, 1e-8 * theta);
  }
}

/// Counts of 6^dim cells against the C-volumes of the cells.
void expect_sampler(const Copula& copula, const std::string& what) {
  constexpr Index kDraws = 50000;
  constexpr int kEdges = 7;
  const std::array<double, kEdges> edges{0, 0.02, 0.2, 0.5, 0.8, 0.98, 1};
  const int dim = copula.dim();
  const auto cells = static_cast<std::size_t>(std::lround(std::pow(kEdges - 1, dim)));
  const auto digit = [](std::size_t cell, int k) {
    return cell / static_cast<std::size_t>(std::lround(std::pow(6, k))) % 6;
  };
  std::vector<double> expected(cells), observed(cells);
  for (std::size_t cell = 0; cell < cells; ++cell) {
    Points corners(1 << dim, dim);
    Column sign = Column::Constant(1 << dim, static_cast<double>(kDraws));
    for (int corner = 0; corner < 1 << dim; ++corner) {
      for (int k = 0; k < dim; ++k) {
        const bool high = (corner >> k & 1) != 0;
        corners(corner, k) = edges[digit(cell, k) + (high ? 1 : 0)];
        if (!high) sign(corner) = -sign(corner);
      }
    }
    expected[cell] = std::max(0.0, (sign * copula.cdf(corners)).sum());
  }
  Rng rng(test::seed_of_this_test());
  const Points u = copula.sample(kDraws, rng);
  for (Index row = 0; row < kDraws; ++row) {
    std::size_t cell = 0;
    for (int k = dim; k-- > 0;) {
      const auto above = std::upper_bound(edges.begin() + 1, edges.end() - 1, u(row, k));
      cell = cell * 6 + static_cast<std::size_t>(above - edges.begin() - 1);
    }
    ++observed[cell];
  }
  test::expect_chi_square(observed, expected, 6, what);
}

TEST(FormulaFamily, DrawsOfTheExamplesFollowTheCellProbabilities) {
  for (const int dim : {2, 3}) {
    expect_sampler(*example("inverse_gaussian").make(dim, {2}), "inverse gaussian");
    expect_sampler(*example("bb1").make(dim, {0.5, 1.5}), "bb1");
    expect_sampler(*example("nelsen_4_2_12").make(dim, {1.5}), "nelsen 4.2.12");
  }
}

TEST(FormulaFamily, FitsRecoverTheParametersOfTheExamples) {
  const std::vector<std::pair<std::string, Theta>> cases{
      {"inverse_gaussian", {2}}, {"bb1", {0.5, 1.5}}, {"nelsen_4_2_12", {2}}};
  for (const auto& [name, theta] : cases) {
    Rng rng(test::seed_of_this_test());
    const Points u = example(name).make(3, theta)->sample(3000, rng);
    const FitResult result = fit_maximum_likelihood(example(name), u);
    EXPECT_EQ(result.status, FitStatus::converged) << name << ": " << result.message;
    for (std::size_t i = 0; i < theta.size(); ++i) {
      EXPECT_NEAR(result.theta[i], theta[i], 4 * result.standard_error[i]) << name;
      EXPECT_LT(result.standard_error[i], 0.1 * theta[i]) << name;
    }
  }
}

TEST(FormulaFamily, AModelFileStandsAlone) {
  const FamilyInfo& family = example("bb1");
  const CopulaModel model{
      .dim = 3, .components = {{.family = family.name, .theta = {0.5, 1.5}, .definition = family.definition}}};
  const std::string json = to_json(model);
  const CopulaModel back = parse_model(json, "model.json", {});
  EXPECT_EQ(to_json(back), json);
  const Points u = Points::Constant(1, 3, 0.3);
  EXPECT_EQ(make_copula(back, {})->log_pdf(u)(0), family.make(3, {0.5, 1.5})->log_pdf(u)(0));
  std::string broken = json;
  broken.replace(broken.find("(1+"), 3, "(x+");
  EXPECT_TRUE(error_of([&] { (void)parse_model(broken, "model.json", {}); }).starts_with("model.json: "));
}

TEST(FormulaFamily, IsRotatedLikeAnyOther) {
  const FamilyInfo& family = families::resolve(path_of("bb1") + "@180");
  EXPECT_EQ(family.name, "bb1@180");
  EXPECT_EQ(&families::resolve(path_of("bb1") + "@180"), &family);
  EXPECT_EQ(family.tails({0.5, 1.5}).lower, example("bb1").tails({0.5, 1.5}).upper);
  const CopulaModel model{
      .dim = 3, .components = {{.family = family.name, .theta = {0.5, 1.5}, .definition = family.definition}}};
  const std::string json = to_json(model);
  const CopulaModel back = parse_model(json, "model.json", {});
  EXPECT_EQ(to_json(back), json);
  EXPECT_EQ(back.components[0].family, "bb1@180");
  const Points u = Points::Constant(1, 3, 0.25);
  EXPECT_EQ(make_copula(back, {})->log_pdf(u)(0), example("bb1").make(3, {0.5, 1.5})->log_pdf(1 - u)(0));
}

}  // namespace
}  // namespace sklar::symbolic
