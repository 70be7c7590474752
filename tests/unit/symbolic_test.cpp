#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <random>
#include <sstream>
#include <thread>

#include "copula/error.hpp"
#include "copula/symbolic/derivative.hpp"
#include "copula/symbolic/derive.hpp"
#include "copula/symbolic/evaluate.hpp"
#include "copula/symbolic/parser.hpp"
#include "copula/symbolic/print.hpp"
#include "tests/support/message.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/unit/symbolic_generators.hpp"

namespace sklar::symbolic {
namespace {

using sklar::test::message_of;
using test::generators;
using test::random_expression;

struct Equality {
  const char* left;
  const char* right;
};

TEST(SymbolicExpression, EqualFormulasAreOneNode) {
  for (const auto& [left, right] : std::vector<Equality>{{"0.1 + 0.2", "3/10"},
                                                         {"2.50e-1", "1/4"},
                                                         {"t + theta + t", "2*t + theta"},
                                                         {"t*t^2*theta/t", "t^2*theta"},
                                                         {"(2*t + 2)*(1 + t)^-1", "2"},
                                                         {"(t - 1)/(1 - t)", "-1"},
                                                         {"exp(t)*exp(-theta)", "exp(t - theta)"},
                                                         {"exp(2*log(t))", "t^2"},
                                                         {"log(exp(t))", "t"},
                                                         {"sqrt(12)/sqrt(3)*3^(3/2)", "sqrt(12)*3"},
                                                         {"8^(1/3)", "2"},
                                                         {"log1p(expm1(t))", "t"},
                                                         {"pow(t, 2)^theta", "(t^2)^theta"},
                                                         {"-2^2", "-(2^2)"},
                                                         {"2^3^2", "512"},
                                                         {"2^-1", "1/2"},
                                                         {"1/2/2", "1/4"},
                                                         {"1 - 2 - 3", "-4"},
                                                         {"--t", "t"},
                                                         {"gamma(5)", "24"},
                                                         {"polygamma(0, t)", "digamma(t)"},
                                                         {"pi", "4*atan(1)"}}) {
    EXPECT_EQ(parse(left), parse(right)) << left << " gives " << to_text(parse(left));
  }
}

TEST(SymbolicExpression, DifferentFunctionsStayApart) {
  EXPECT_NE(parse("(t^2)^(1/2)"), parse("t"));
  EXPECT_NE(parse("log(t^2)"), parse("2*log(t)"));
  EXPECT_NE(parse("(t - 1)^(1/2)"), parse("(1 - t)^(1/2)"));
  EXPECT_NE(parse("(t*theta)^(1/2)"), parse("t^(1/2)*theta^(1/2)"));
}

TEST(SymbolicExpression, RootsOfAnyOrderAreExactOrStay) {
  EXPECT_EQ(parse("3^(700/7)"), parse("3^100"));
  for (const char* order : {"3", "91000000", "4294967297", "1e30"}) {  // 2^32 + 1 among them
    const Expression root = parse("7^(1/" + std::string(order) + ")");
    EXPECT_EQ(root.kind(), Kind::power) << order << ": " << to_text(root);
  }
}

TEST(SymbolicExpression, IsSharedBetweenThreads) {
  std::vector<Expression> results(8);
  std::vector<std::thread> threads;
  threads.reserve(results.size());
  for (Expression& result : results) {
    threads.emplace_back([&result] {
      for (int i = 0; i < 20; ++i) {
        for (const auto& generator : generators()) result = derivative(parse(generator.psi), symbol("t"), 4);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const Expression& result : results) EXPECT_EQ(result, results.front());
}

struct BadText {
  std::string text;
  std::size_t position;
  const char* phrase;
};

TEST(SymbolicParser, NamesThePlaceOfAnError) {
  for (const BadText& bad : std::vector<BadText>{{"", 0, "empty"},
                                                 {"1 +", 3, "got the end"},
                                                 {"log(1 + (t", 10, "')' was expected"},
                                                 {"(1 + t]", 6, "')' was expected, got ']'"},
                                                 {"1 + t)", 5, "got ')'"},
                                                 {"2t", 1, "operator was expected"},
                                                 {"t theta", 2, "operator or the end"},
                                                 {"1..2", 2, "operator was expected"},
                                                 {"t * * 2", 4, "got '*'"},
                                                 {"1/(2 - 2)", 1, "division by zero"},
                                                 {"0^-1", 1, "division by zero"},
                                                 {"1 + foo(t)", 4, "unknown function 'foo'"},
                                                 {"1 + psi", 4, "unknown symbol 'psi'; allowed are t, theta"},
                                                 {"exp(t, 2)", 0, "exp takes 1 argument, got 2"},
                                                 {"pow(t)", 0, "pow takes 2 arguments, got 1"},
                                                 {"exp t", 4, "'(' was expected after the function exp"},
                                                 {"polygamma(t, 1)", 0, "whole number"},
                                                 {"1e99999", 0, "more than 5000 digits"},
                                                 {"t + \xCE\xB8", 4, "outside ASCII"},
                                                 {std::string(5000, '('), 400, "nested too deeply"},
                                                 {"2" + std::string(5000, '^') + "2", 2, "a number, a symbol"}}) {
    try {
      (void)parse(bad.text, {"t", "theta"});
      ADD_FAILURE() << "accepted " << bad.text;
    } catch (const ParseError& error) {
      EXPECT_EQ(error.position(), bad.position) << bad.text << ": " << error.what();
      EXPECT_NE(std::string(error.what()).find(bad.phrase), std::string::npos) << error.what();
    }
  }
}

TEST(SymbolicParser, PutsACaretUnderThePlace) {
  try {
    (void)parse("1 +\n  log(t");
    FAIL() << "no exception";
  } catch (const ParseError& error) {
    EXPECT_STREQ(error.what(), "',' or ')' was expected, got the end at position 12\n    log(t\n         ^");
  }
}

TEST(SymbolicParser, RefusesNumbersTooLongToCalculateWith) {
  const auto repeated = [](const std::string& part) {
    std::string text = "1";
    for (int n = 0; n < 50; ++n) text += part;
    return text;
  };
  for (const std::string& text : {repeated("*3^8000"), repeated("+1/7^5000+1/11^4000+1/13^4000")}) {
    EXPECT_NE(message_of<ParseError>([&] { (void)parse(text); }).find("a number of more than 32768 bits"),
              std::string::npos)
        << text;
  }
  EXPECT_EQ(parse(repeated("+3^-40000")), parse("1 + 50/3^40000"));
}

TEST(SymbolicParser, LeavesHugePowersAlone) {
  EXPECT_EQ(parse("9^9^9").kind(), Kind::power);
  EXPECT_EQ(parse("(1 + t)^1000000").kind(), Kind::power);
}

TEST(SymbolicPrinter, TextReadsBack) {
  std::mt19937_64 rng(20231);
  for (int i = 0; i < 5000; ++i) {
    const Expression e = random_expression(rng, 5);
    ASSERT_EQ(parse(to_text(e)), e) << to_text(e) << "\n" << to_text(parse(to_text(e)));
  }
  for (const auto& generator : generators()) {
    Derivatives d(parse(generator.psi), symbol("t"));
    for (int order = 0; order <= 8; ++order) {
      EXPECT_EQ(parse(to_text(d(order))), d(order)) << generator.name << " order " << order;
    }
  }
}

TEST(SymbolicPrinter, Latex) {
  EXPECT_EQ(to_latex(parse("exp(-t^(1/theta))")), "\\exp\\left(-t^{1/\\theta}\\right)");
  EXPECT_EQ(to_latex(parse("(1 - theta)/(exp(t) - theta)")), "-\\frac{1 - \\theta}{\\theta - e^{t}}");
  EXPECT_EQ(to_latex(parse("sqrt(t)/2 + beta_1 - x12*rate")),
            "\\beta_{1} + \\frac{\\sqrt{t}}{2} - \\mathrm{rate} x_{12}");
  EXPECT_EQ(derive("(1 + theta*t)^(-1/theta)", 1, Language::latex), "-\\left(1 + t \\theta\\right)^{-1 - 1/\\theta}");
}

TEST(SymbolicDerivative, OfElementaryFunctions) {
  const Expression t = symbol("t");
  for (const auto& [f, df] : std::vector<Equality>{{"t^5", "5*t^4"},
                                                   {"theta", "0"},
                                                   {"sin(2*t)", "2*cos(2*t)"},
                                                   {"cos(t)", "-sin(t)"},
                                                   {"tan(t)", "1 + tan(t)^2"},
                                                   {"atan(t)", "1/(1 + t^2)"},
                                                   {"log(abs(t))", "1/t"},
                                                   {"lgamma(t)", "digamma(t)"},
                                                   {"polygamma(2, t)", "polygamma(3, t)"},
                                                   {"lambertw(t)", "lambertw(t)/(t*(1 + lambertw(t)))"},
                                                   {"2^t", "2^t*log(2)"},
                                                   {"t^t", "t^t + t^t*log(t)"}}) {
    EXPECT_EQ(derivative(parse(f), t), parse(df)) << f << " gives " << to_text(derivative(parse(f), t));
  }
  EXPECT_EQ(derivative(parse("(1 - t)^3"), t, 4), Expression(0));
  EXPECT_THROW((void)derivative(t, t, -1), std::invalid_argument);
  EXPECT_THROW((void)derivative(t, parse("t^2")), std::invalid_argument);
}

// The number of nodes of order n grows like n, or like n^2 / 2 where the coefficients obey a two-term recurrence.
TEST(SymbolicDerivative, StaysSmall) {
  std::printf("nodes of the derivatives of order 1..12\n");
  for (const auto& generator : generators()) {
    const auto start = std::chrono::steady_clock::now();
    Derivatives d(parse(generator.psi), symbol("t"));
    std::string sizes;
    for (int order = 1; order <= 12; ++order) {
      const std::size_t nodes = node_count(d(order));
      sizes += " " + std::to_string(nodes);
      EXPECT_LE(nodes, 24u + 9u * order + 2u * order * order) << generator.name << " order " << order;
    }
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
    std::printf("%-18s%s   %.1f ms\n", generator.name, sizes.c_str(), elapsed.count());
  }
}

TEST(SymbolicDerive, RefusesOrdersOutOfRange) {
  EXPECT_THROW((void)derive("exp(-t)", -1, Language::text), std::invalid_argument);
  EXPECT_THROW((void)derive("exp(-t)", kMaxDeriveOrder + 1, Language::text), std::invalid_argument);
  EXPECT_THROW((void)derive("lambertw(t)", 1, Language::cpp), std::invalid_argument);
  EXPECT_THROW((void)language_named("fortran"), std::invalid_argument);
}

TEST(SymbolicDerive, PrintsOneLine) {
  EXPECT_EQ(derive("exp(-theta*t)", 3, Language::text), "-theta^3*exp(-t*theta)");
}

using SymbolicCpp = sklar::test::TemporaryFolder;

/// Compiles a program with all warnings as errors and returns what it prints.
std::string compile_and_run(const std::filesystem::path& folder, const std::string& source) {
  const std::string stem = (folder / "program").string();
  std::ofstream(stem + ".cpp") << source;
  const std::string command = std::string(SKLAR_CXX_COMPILER) +
                              " -std=c++20 -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror " + stem +
                              ".cpp -o " + stem + " && " + stem;
  FILE* pipe = popen(command.c_str(), "r");
  std::string output;
  char buffer[256];
  while (pipe && std::fgets(buffer, sizeof buffer, pipe)) output += buffer;
  EXPECT_EQ(pipe ? pclose(pipe) : -1, 0) << source;
  return output;
}

/// The generated functions of all generators and orders, each in a namespace, and one with awkward names.
class Program {
 public:
  Program() {
    for (const auto& generator : generators()) {
      const std::string space = "g" + std::to_string(spaces_++);
      const bool two = std::string(generator.psi).find("delta") != std::string::npos;
      const bool none = std::string(generator.psi).find("theta") == std::string::npos;
      const double theta = generator.name == std::string("ali-mikhail-haq") ? 0.5 : 1.5;
      for (const int order : {0, 1, 4}) {
        const std::string arguments =
            none ? "(0.7)" : "(0.7, " + std::string(two ? "1.25, " : "") + to_text(theta) + ")";
        const std::string call = space + "::dpsi_" + std::to_string(order);
        add("namespace " + space + " {\n" + without_include(derive(generator.psi, order, Language::cpp)) + "}\n",
            call + arguments, value(generator.psi, order, theta));
      }
    }
    add(without_include(to_cpp(parse("v1*exp(-double)/3 + f*sqrt(std)"), "f", {"v1", "double", "f", "std", "unused"})),
        "f(3, 0, 2, 4, 0)", 5);
  }

  [[nodiscard]] std::string source() const {
    return "#include <cmath>\n#include <cstdio>\n" + functions_ + "int main() {\n" + calls_ + "}\n";
  }
  [[nodiscard]] const std::vector<double>& expected() const { return expected_; }

 private:
  void add(const std::string& function, const std::string& call, double value) {
    functions_ += function;
    calls_ += "  std::printf(\"%.17g\\n\", " + call + ");\n";
    expected_.push_back(value);
  }

  static std::string without_include(const std::string& function) {
    const std::string include = "#include <cmath>\n";
    EXPECT_EQ(function.find(include), 0u);
    return function.substr(include.size());
  }

  static std::string to_text(double value) { return sklar::to_text(value); }

  static double value(const char* psi, int order, double theta) {
    const Tape tape({derivative(parse(psi), symbol("t"), order)}, {"t", "delta", "theta"});
    Points at(1, 3);
    at << 0.7, 1.25, theta;
    return evaluate(tape, at).values(0, 0);
  }

  int spaces_ = 0;
  std::string functions_;
  std::string calls_;
  std::vector<double> expected_;
};

TEST_F(SymbolicCpp, CompilesWithoutWarningsAndAgrees) {
  constexpr double kRelativeTolerance = 1e-13;  // double arithmetic at ordinary points, order 4
  const Program program;
  std::istringstream printed(compile_and_run(folder_, program.source()));
  for (std::size_t i = 0; i < program.expected().size(); ++i) {
    double value = 0;
    ASSERT_TRUE(printed >> value) << "call " << i;
    EXPECT_NEAR(value / program.expected()[i], 1, kRelativeTolerance) << "call " << i;
  }
}

}  // namespace
}  // namespace sklar::symbolic
