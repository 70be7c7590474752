#include "brdf/code/model_code.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <regex>
#include <sstream>

#include "brdf/code/cpp_header.hpp"
#include "brdf/code/glsl.hpp"
#include "brdf/code/source_text.hpp"
#include "brdf/model/coupling.hpp"
#include "copula/error.hpp"
#include "copula/random.hpp"
#include "families/registry.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sklar::brdf {
namespace {

/// How far a text may be from the library: relative but for directions.
struct Tolerance {
  double eval;       ///< of Named::exact
  double pdf;        ///< of ConditionalSampler::pdf, which is exact to 1e-5
  double direction;  ///< of ConditionalSampler::sample_direction
  double weight;     ///< of f_r cos / pdf at what was drawn, by Brdf::eval
};
constexpr Tolerance kTables{.eval = 1e-6, .pdf = 1e-5, .direction = 1e-5, .weight = 3e-5};  // in double but for tables
constexpr Tolerance kSingle{.eval = 2e-5, .pdf = 1e-4, .direction = 2e-5, .weight = 1e-4};
constexpr double kAnisotropic = 1e-5;  ///< of AnisotropicModel::eval, added to eval and weight

/// A model with coefficients drawn at random, each copula at tau of about 0.3.
std::shared_ptr<const RefinedBrdf> random_model(const RefinedStructure& structure,
                                                const std::vector<std::string>& names, std::uint64_t seed) {
  std::vector<FamilyInfo> families;
  families.reserve(names.size());
  for (const std::string& name : names) families.push_back(families::resolve(name));
  const RefinedLayout layout(structure, coupled(families));
  std::vector<double> x(static_cast<std::size_t>(layout.size()));
  Rng rng(seed);
  for (int k = 0; k < structure.components; ++k) {
    const FamilyInfo& family = families[static_cast<std::size_t>(k)];
    const double dependence = family.parameters.empty() ? 0 : Coupling(family).dependence(0.3);
    for (const RefinedPart part : kRefinedParts) {
      for (int i = 0; i < layout.count(k, part); ++i) {
        const double at = part == RefinedPart::shape ? -12.0 * (i % structure.half) / structure.half : 0;
        x[static_cast<std::size_t>(layout.first(k, part) + i)] =
            (part == RefinedPart::coupling ? dependence : at) + (uniform(rng) - 0.5);
      }
    }
  }
  return std::make_shared<RefinedBrdf>(structure, families, pack(layout, 16, x));
}

std::shared_ptr<const AnisotropicModel> random_model(const AnisotropicStructure& structure, std::uint64_t seed) {
  const AnisotropicLayout layout(structure);
  std::vector<double> x(static_cast<std::size_t>(layout.size()));
  Rng rng(seed);
  for (int k = 0; k < structure.components; ++k) {
    for (const AnisotropicPart part : kAnisotropicParts) {
      for (int i = 0; i < layout.count(part); ++i) {
        double at = part == AnisotropicPart::shape ? -12.0 * (i % structure.half) / structure.half : 0;
        if (part == AnisotropicPart::metric && i == 0) at = 3;  // the log of the scale
        x[static_cast<std::size_t>(layout.first(k, part) + i)] = at + (uniform(rng) - 0.5);
      }
    }
  }
  return std::make_shared<AnisotropicModel>(structure, pack(layout, 16, x));
}

/// A model with what the tests compare.
struct Named {
  Named(std::string name_, const std::shared_ptr<const RefinedBrdf>& model)
      : name(std::move(name_)),
        brdf(model),
        evaluation(evaluation_code(*model)),
        exact([model](const Vec3& wo, const Vec3& wi) { return model->at(coordinates(model->structure(), wo, wi)); }),
        sampler(*model) {}
  Named(std::string name_, const std::shared_ptr<const AnisotropicModel>& model)
      : name(std::move(name_)),
        brdf(model),
        evaluation(evaluation_code(*model)),
        exact([model](const Vec3& wo, const Vec3& wi) { return model->eval(wo, wi); }),
        rounding(kAnisotropic),
        sampler(*model) {}
  [[nodiscard]] ModelCode code() const { return with_sampler(evaluation, sampler); }

  std::string name;
  BrdfPtr brdf;
  ModelCode evaluation;
  std::function<Rgb(const Vec3& wo, const Vec3& wi)> exact;  ///< f_r, above the horizon
  double rounding = 0;                                       ///< of exact and of the model's eval
  ConditionalSampler sampler;
};

/// Numbers of components, with and without copulas, on parts of the axes, all degrees; anisotropic ones.
const std::vector<Named>& models() {
  static const std::vector<Named> kModels = [] {
    const RefinedStructure least{.components = 1,
                                 .half = 4,
                                 .difference = 4,
                                 .colour_half = 4,
                                 .colour_difference = 4,
                                 .azimuth = 0,
                                 .azimuth_difference = 4,
                                 .coupling_difference = 4};
    RefinedStructure three = least, part = least, most = {};
    three.components = 3;
    three.half = 12;
    three.colour_half = 6;
    three.azimuth = 3;
    part.components = 2;
    part.half_range = {8, 60};
    part.difference_range = {3, 40};
    part.azimuth = 1;
    part.colour_half = 1;
    part.colour_difference = 1;
    most.components = kMostComponents;
    most.azimuth = kHighestDegree;
    most.width = 0.5;
    const AnisotropicStructure tilted{.components = 2,
                                      .half = 9,
                                      .difference = 5,
                                      .colour_half = 6,
                                      .colour_difference = 0,
                                      .azimuth = 6,
                                      .azimuth_difference = 1,
                                      .masking = 6,
                                      .masking_harmonics = 1,
                                      .half_harmonics = 2,
                                      .half_harmonics_degree = 6,
                                      .tilted = true};
    const AnisotropicStructure no_terms{.components = 1,
                                        .half = 4,
                                        .difference = 4,
                                        .colour_half = 0,
                                        .colour_difference = 0,
                                        .azimuth = 0,
                                        .azimuth_difference = 0,
                                        .masking = 0,
                                        .masking_harmonics = 0,
                                        .half_harmonics = 0,
                                        .half_harmonics_degree = 0};
    return std::vector<Named>{
        {"least", random_model(least, {"independence"}, 1)},
        {"coupled", random_model(three, {"independence", "clayton@90", "frank"}, 2)},
        {"on a part", random_model(part, {"gumbel", "independence"}, 3)},
        {"most", random_model(most, std::vector<std::string>(kMostComponents, "independence"), 4)},
        {"anisotropic", random_model(AnisotropicStructure{}, 5)},
        {"tilted", random_model(tilted, 6)},
        {"no terms", random_model(no_terms, 7)},
    };
  }();
  return kModels;
}

/// Unit directions exact in single precision, some below the horizon, with the normal, pairs at mirror directions and
/// grazing ones.
struct Pairs {
  Directions wo, wi;
  Eigen::ArrayX2d uniforms;
};

Vec3 in_single(const Vec3& w) {
  return w.cast<float>().cast<double>();
}

Pairs pairs_of_directions() {
  constexpr Eigen::Index kCount = 400;
  Rng rng(5);
  const auto direction = [&] {
    const double z = 1.05 * uniform(rng) - 0.05, phi = 2 * std::numbers::pi * uniform(rng), r = std::sqrt(1 - z * z);
    return Vec3(r * std::cos(phi), r * std::sin(phi), z);
  };
  Pairs pairs{Directions(kCount, 3), Directions(kCount, 3), Eigen::ArrayX2d(kCount, 2)};
  for (Eigen::Index i = 0; i < kCount; ++i) {
    const Vec3 wo = direction();
    const Vec3 mirror = (Vec3(-wo.x(), -wo.y(), wo.z()) + 0.01 * static_cast<double>(i % 3) * direction()).normalized();
    pairs.wo.row(i) = in_single(i == 0 ? Vec3(0, 0, 1) : wo);
    pairs.uniforms.row(i) << static_cast<float>(uniform(rng)), static_cast<float>(uniform(rng));
    pairs.wi.row(i) = in_single(i == 0 ? Vec3(0, 0, 1) : i % 2 == 0 ? mirror : direction());
  }
  return pairs;
}

/// Numbers that a program made of the models' headers gives for each pair: for each model those of eval, of
/// pdf, and of sample.
class ModelCode : public test::TemporaryFolder {
 protected:
  static constexpr Eigen::Index kNumbers = 11;

  /// @param header of a model, changed.
  template <class Header>
  Eigen::ArrayXXd run(const Pairs& pairs, const Header& header) const {
    std::string includes, calls;
    for (std::size_t m = 0; m < models().size(); ++m) {
      const std::string name = "m" + std::to_string(m);
      std::ofstream(folder_ / (name + ".hpp")) << header(to_cpp_header(models()[m].code(), name));
      includes += "#include \"" + name + ".hpp\"\n";
      calls += "call_" + name + "(x);\n";
      includes += "void call_" + name + "(const double* x) {\n  using namespace " + cpp_namespace(name) + R"(;
  using real = decltype(vec3::x);
  const vec3 wo{real(x[0]), real(x[1]), real(x[2])}, wi{real(x[3]), real(x[4]), real(x[5])};
  const vec3 f = eval(wo, wi);
  const Sample s = sample(wo, {real(x[6]), real(x[7])});
  const double out[] = {f.x,     f.y,   f.z,        pdf(wo, wi), s.wi.x,    s.wi.y,
                        s.wi.z, s.pdf, s.weight.x, s.weight.y,  s.weight.z};
  std::fwrite(out, sizeof out, 1, stdout);
}
)";
    }
    std::ofstream(folder_ / "program.cpp") << "#include <cstdio>\n" + includes + "int main() {\n  double x[8];\n" +
                                                  "  while (std::fread(x, sizeof x, 1, stdin) == 1) {\n" + calls +
                                                  "}\n}\n";
    Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> in(pairs.wo.rows(), 8),
        out(pairs.wo.rows(), kNumbers * static_cast<Eigen::Index>(models().size()));
    in << pairs.wo, pairs.wi, pairs.uniforms;
    const auto size = [](const auto& rows) { return static_cast<std::streamsize>(rows.size() * 8); };
    std::ofstream(folder_ / "in", std::ios::binary).write(reinterpret_cast<const char*>(in.data()), size(in));
    const std::string command = "cd '" + folder_.string() + "' && " SKLAR_CXX_COMPILER +
                                " -std=c++17 -O1 -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror program.cpp"
                                " -o program && ./program < in > out";
    EXPECT_EQ(std::system(command.c_str()), 0);
    std::ifstream result(folder_ / "out", std::ios::binary);
    result.read(reinterpret_cast<char*>(out.data()), size(out));
    EXPECT_EQ(result.gcount(), size(out));
    return out;
  }

  static void expect_as_the_library(const Pairs& pairs, const Eigen::ArrayXXd& found, const Tolerance& tolerance) {
    for (std::size_t m = 0; m < models().size(); ++m) {
      const Named& named = models()[m];
      SCOPED_TRACE(named.name);
      Tolerance worst{};
      for (Eigen::Index i = 0; i < pairs.wo.rows(); ++i) {
        const Tolerance error = errors(named, pairs.wo.row(i), pairs.wi.row(i), pairs.uniforms.row(i),
                                       found.row(i).segment<kNumbers>(static_cast<Eigen::Index>(m) * kNumbers));
        worst = {.eval = std::max(worst.eval, error.eval),
                 .pdf = std::max(worst.pdf, error.pdf),
                 .direction = std::max(worst.direction, error.direction),
                 .weight = std::max(worst.weight, error.weight)};
      }
      EXPECT_LT(worst.eval, tolerance.eval + named.rounding);
      EXPECT_LT(worst.pdf, tolerance.pdf);
      EXPECT_LT(worst.direction, tolerance.direction);
      EXPECT_LT(worst.weight, tolerance.weight + named.rounding);
    }
  }

 private:
  static double relative(double value, double exact) {
    return std::isfinite(value) ? std::abs(value - exact) / (exact > 0 ? exact : 1) : HUGE_VAL;
  }
  static double relative(const Rgb& value, const Rgb& exact) {
    return std::max({relative(value(0), exact(0)), relative(value(1), exact(1)), relative(value(2), exact(2))});
  }

  static Tolerance errors(const Named& named, const Vec3& wo, const Vec3& wi, const Vec2& uniforms,
                          const Eigen::Array<double, 1, kNumbers>& row) {
    const bool above = wo.z() > 0 && wi.z() > 0;
    const Vec3 drawn(row(4), row(5), row(6));
    const double pdf = named.sampler.pdf(wo, drawn);
    const Rgb weight = pdf > 0 ? Rgb(named.brdf->eval(wo, drawn) * (drawn.z() / pdf)) : Rgb::Zero();
    return {.eval = relative(row.segment<3>(0), above ? named.exact(wo, wi) : Rgb::Zero()),
            .pdf = std::max(relative(row(3), named.sampler.pdf(wo, wi)), relative(row(7), pdf)),
            .direction = relative((drawn - named.sampler.sample_direction(wo, uniforms)).norm(), 0),
            .weight = relative(row.segment<3>(8), weight)};
  }
};

/// A header that computes in single precision, as a shader does.
std::string in_single_precision(const std::string& header) {
  const std::string types = std::regex_replace(header, std::regex("\\bdouble\\b"), "float");
  return std::regex_replace(types, std::regex("(\\d\\.\\d+(e-?\\d+)?|\\de-\\d+)(?![\\dFe.])"), "$1F");
}

TEST_F(ModelCode, IsTheModelAndItsSamplerInCpp) {
  const Pairs pairs = pairs_of_directions();
  expect_as_the_library(pairs, run(pairs, [](const std::string& header) { return header; }), kTables);
}

TEST_F(ModelCode, IsTheModelAndItsSamplerInSinglePrecision) {
  const Pairs pairs = pairs_of_directions();
  expect_as_the_library(pairs, run(pairs, in_single_precision), kSingle);
}

/// What glslangValidator says of a shader; empty where it has no objection.
std::string objections(const std::filesystem::path& folder, const std::string& shader, const std::string& stage) {
  const std::string file = (folder / ("shader." + stage)).string();
  std::ofstream(file) << shader;
  FILE* pipe = popen((std::string(SKLAR_GLSL_VALIDATOR) + " '" + file + "' 2>&1").c_str(), "r");
  std::string output;
  char buffer[256];
  while (pipe && std::fgets(buffer, sizeof buffer, pipe)) output += buffer;
  return pipe && pclose(pipe) == 0 ? "" : output;
}

TEST_F(ModelCode, IsGlslOfAllVersionsFrom130) {
  if (std::string(SKLAR_GLSL_VALIDATOR).empty()) GTEST_SKIP() << "no glslangValidator";
  const std::string precision = "precision highp float;\nprecision highp int;\n";
  const std::string main =
      "\nin vec3 wo, wi;\nout vec3 value;\nvoid main() {\n"
      "  sklar_Sample s = sklar_sample(wo, wi.xy);\n  value = sklar_eval(wo, wi) + sklar_pdf(wo, wi) * s.weight;\n}\n";
  for (const Named& named : models()) {
    const std::string code = to_glsl(named.code(), named.name).append(main);
    EXPECT_EQ(objections(folder_, std::string("#version 130\n").append(code), "frag"), "");
    EXPECT_EQ(objections(folder_, std::string("#version 410\n").append(code), "vert"), "");
    EXPECT_EQ(objections(folder_, std::string("#version 300 es\n").append(precision).append(code), "frag"), "");
  }
  const std::string wrong = to_glsl({"vec3 sklar_eval(vec3 wo, vec3 wi) { return 1; }", {1}}, "wrong");
  EXPECT_NE(objections(folder_, "#version 130\n" + wrong + main, "frag"), "");
}

/// The shader of a .brdf file as BRDF Explorer reads it: lines that are blank or begin with # are left out.
std::string shader_of(const std::string& file) {
  std::istringstream lines(file);
  std::string line, section, shader;
  std::getline(lines, line);
  EXPECT_EQ(line, "analytic");
  while (std::getline(lines, line)) {
    if (line.empty() || line.front() == '#') continue;
    if (line.starts_with("::")) {
      const bool begins = line.starts_with("::begin ");
      EXPECT_EQ(section.empty(), begins);
      EXPECT_TRUE(begins || line == "::end " + section) << line;
      section = begins ? line.substr(8) : "";
    } else if (section == "shader") {
      shader += line + "\n";
    } else {
      ADD_FAILURE() << "outside of the shader: " << line;
    }
  }
  EXPECT_EQ(section, "");
  return shader;
}

// The versions of its templates, in both stages in which it evaluates.
TEST_F(ModelCode, IsAShaderOfBrdfExplorer) {
  if (std::string(SKLAR_GLSL_VALIDATOR).empty()) GTEST_SKIP() << "no glslangValidator";
  const std::string main =
      "in vec3 a, b;\nout vec3 value;\nvoid main() { value = BRDF(a, b, vec3(0,0,1), vec3(1,0,0), vec3(0,1,0)); }\n";
  for (const Named& named : models()) {
    const std::string shader = shader_of(to_brdf_explorer(named.evaluation, "line\n::end shader"));
    EXPECT_NE(shader.find("vec3 BRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y)"), std::string::npos);
    EXPECT_EQ(objections(folder_, std::string("#version 410\n").append(shader).append(main), "vert"), "");
    EXPECT_EQ(objections(folder_, std::string("#version 130\n").append(shader).append(main), "frag"), "");
  }
}

TEST(SourceText, NumbersReadBackAndAreNotIntegers) {
  EXPECT_EQ(number_text(1.0F), "1.0");
  EXPECT_EQ(number_text(-80.0), "-80.0");
  EXPECT_EQ(number_text(1e-20F), "1e-20");
  EXPECT_EQ(constant_text("one", 1), "const int sklar_one = 1;\n");
  EXPECT_EQ(constant_text("width", 0.05), "const float sklar_width = 0.05;\n");
  Rng rng(6);
  for (int i = 0; i < 1000; ++i) {
    const auto value = static_cast<float>(std::exp(40 * (uniform(rng) - 0.5)));
    EXPECT_EQ(std::stof(number_text(value)), value);
  }
  EXPECT_EQ(cpp_namespace("alum-bronze 2"), "sklar_alum_bronze_2");
}

}  // namespace
}  // namespace sklar::brdf
