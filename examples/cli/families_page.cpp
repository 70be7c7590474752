#include "examples/cli/families_page.hpp"

#include <array>
#include <cstdio>

#include "copula/listed.hpp"
#include "copula/symbolic/derivative.hpp"
#include "copula/symbolic/derive.hpp"
#include "copula/symbolic/parser.hpp"
#include "copula/symbolic/print.hpp"

namespace sklar::cli {
namespace {

constexpr std::array<int, 5> kDimensions = {2, 3, 4, 5, 10};
constexpr int kOrders = 3;  // of the derivatives shown

std::string rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

std::string rounded(const Theta& theta) {
  return listed(theta, [](double value) { return rounded(value); });
}

std::string formula(const std::string& latex) {
  return "$$" + latex + "$$\n\n";
}

std::string generator(const FamilyInfo& family) {
  if (family.psi.empty()) return "No generator (" + family.source + ").\n\n";
  std::string text = formula("\\psi(t) = " + symbolic::to_latex(symbolic::parse(family.psi)));
  for (int order = 1; order <= kOrders; ++order) {
    const std::string left = order == 1 ? "\\psi'(t) = " : "\\psi^{(" + std::to_string(order) + ")}(t) = ";
    text += formula(left + symbolic::derive(family.psi, order, symbolic::Language::latex));
  }
  text += "`" + family.psi + "` (" + family.source + ")\n\n";
  return family.rotation.none() ? text : text + "Of the copula before rotation.\n\n";
}

std::string domains(const FamilyInfo& family) {
  if (family.parameters.empty()) return "No parameter.\n\n";
  std::string head = "| d |", rule = "| --- |", rows;
  for (const ParameterInfo& parameter : family.parameters) {
    head += " " + parameter.name + " |";
    rule += " --- |";
  }
  for (const int dim : kDimensions) {
    if (!family.dimensions.contains(dim)) continue;
    rows += "| " + std::to_string(dim) + " |";
    for (const ParameterInfo& parameter : family.parameters) rows += " " + parameter.domain(dim).to_text() + " |";
    rows += "\n";
  }
  return head + "\n" + rule + "\n" + rows + "\n";
}

std::string dependence(const FamilyInfo& family) {
  std::string text = "| parameters | Kendall's tau | lower tail | upper tail |\n| --- | --- | --- | --- |\n";
  for (const Theta& theta : family.examples) {
    if (!family.admits(2, theta)) continue;
    const TailDependence tails = family.tails(theta);
    text += "| " + rounded(theta) + " | " + rounded(family.tau(theta)) + " | " + rounded(tails.lower) + " | " +
            rounded(tails.upper) + " |\n";
  }
  return text + "\n";
}

}  // namespace

std::string families_page(std::span<const FamilyInfo* const> families) {
  std::string text =
      "# Families\n\n"
      "C(u) = psi(psi^-1(u_1) + ... + psi^-1(u_d)) with the generators psi below: the formula that the tests hold "
      "every\n"
      "family to, its first derivatives as the library finds them, the parameters admissible in dimension d, and\n"
      "dependence of a pair. Each may be [rotated](conventions.md). This page is the output of\n\n"
      "```\nbuild/sklar families --page -o docs/families.md\n```\n\n";
  for (const FamilyInfo* family : families) {
    text += "## " + family->title + " (`" + family->name + "`)\n\n" + generator(*family) + domains(*family) +
            dependence(*family);
  }
  text.pop_back();
  return text;
}

}  // namespace sklar::cli
