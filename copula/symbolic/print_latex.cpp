#include <algorithm>
#include <array>

#include "copula/symbolic/fraction.hpp"
#include "copula/symbolic/print.hpp"

namespace sklar::symbolic {

namespace {

constexpr std::array kGreek{"alpha", "beta",  "gamma",   "delta", "epsilon", "zeta", "eta",  "theta",
                            "iota",  "kappa", "lambda",  "mu",    "nu",      "xi",   "pi",   "rho",
                            "sigma", "tau",   "upsilon", "phi",   "chi",     "psi",  "omega"};

std::string latex_word(const std::string& word) {
  if (std::find(kGreek.begin(), kGreek.end(), word) != kGreek.end()) return "\\" + word;
  return word.size() == 1 ? word : "\\mathrm{" + word + "}";
}

/// A trailing number or what follows the first underscore is an index.
std::string latex_symbol(const std::string& name) {
  const std::size_t underscore = name.find('_');
  const std::size_t word_end = std::min(underscore, name.find_last_not_of("0123456789") + 1);
  const std::size_t index = underscore == std::string::npos ? word_end : underscore + 1;
  if (word_end == 0) return "\\mathrm{\\_" + latex_symbol(name.substr(1)) + "}";
  const std::string word = latex_word(name.substr(0, word_end));
  if (index >= name.size()) return word;
  std::string text;
  for (const char c : name.substr(index)) text += c == '_' ? std::string("\\_") : std::string(1, c);
  return word + "_{" + text + "}";
}

/// Nothing taller than a letter with an index or a whole exponent.
bool is_flat(const Expression& e) {
  if (e.is_number()) return is_integer(e);
  if (e.kind() == Kind::symbol) return true;
  if (e.kind() == Kind::power)
    return e.args()[0].kind() == Kind::symbol && is_integer(e.args()[1]) && e.args()[1] != Expression(-1);
  return (e.kind() == Kind::sum || e.kind() == Kind::product) && std::all_of(e.args().begin(), e.args().end(), is_flat);
}

/// Fractions have a bar, or a slash in exponents.
class LatexPrinter {
 public:
  explicit LatexPrinter(bool slash) : slash_(slash) {}

  [[nodiscard]] std::string print(const Expression& e) const {
    std::string text;
    for (const Expression& term : terms_of(e)) {
      const Fraction f = split_fraction(term);
      if (text.empty()) {
        text = f.negative ? "-" : "";
      } else {
        text += f.negative ? " - " : " + ";
      }
      text += print_fraction(f);
    }
    return text;
  }

 private:
  [[nodiscard]] std::string parenthesised(const Expression& e) const { return "\\left(" + print(e) + "\\right)"; }

  [[nodiscard]] std::string print_fraction(const Fraction& f) const {
    const bool alone = !f.has_bottom() || !slash_;
    const std::string top = print_factors(f.top_number, f.top, !alone || f.top.size() > 1 || f.top_number != 1);
    if (!f.has_bottom()) return top;
    const bool single = f.bottom.size() + (f.bottom_number != 1 ? 1 : 0) == 1;
    const std::string bottom = print_factors(f.bottom_number, f.bottom, !single || slash_);
    if (!slash_) return "\\frac{" + top + "}{" + bottom + "}";
    return top + "/" + (single ? bottom : "\\left(" + bottom + "\\right)");
  }

  [[nodiscard]] std::string print_factors(const Integer& number, const std::vector<Expression>& factors,
                                          bool protect_sums) const {
    std::string text;
    if (number != 1 || factors.empty()) text = number.str();
    for (const Expression& factor : factors) {
      if (!text.empty()) text += factor.is_number() || is_numeric_power(factor) ? " \\cdot " : " ";
      text += factor.kind() == Kind::sum && !protect_sums ? print(factor) : print_factor(factor);
    }
    return text;
  }

  static bool is_numeric_power(const Expression& e) { return e.kind() == Kind::power && e.args()[0].is_number(); }

  [[nodiscard]] std::string print_factor(const Expression& e) const {
    if (is_square_root(e)) return "\\sqrt{" + LatexPrinter(false).print(e.args()[0]) + "}";
    if (e.kind() == Kind::power) {
      return print_base(e.args()[0]) + "^{" + LatexPrinter(true).print(e.args()[1]) + "}";
    }
    if (e.kind() == Kind::symbol) return latex_symbol(e.name());
    if (e.kind() == Kind::function) return print_function(e);
    return parenthesised(e);
  }

  [[nodiscard]] std::string print_base(const Expression& e) const {
    const bool bare = e.kind() == Kind::symbol || (is_integer(e) && value_of(e) >= 0);
    if (!bare) return parenthesised(e);
    return e.is_number() ? numerator(value_of(e)).str() : latex_symbol(e.name());
  }

  [[nodiscard]] std::string print_function(const Expression& e) const {
    const Expression& x = e.args().back();
    switch (e.function()) {
      case Function::exp:
        if (is_flat(x)) return "e^{" + LatexPrinter(true).print(x) + "}";
        return "\\exp" + parenthesised(x);
      case Function::log:
        return "\\log" + parenthesised(x);
      case Function::sin:
        return "\\sin" + parenthesised(x);
      case Function::cos:
        return "\\cos" + parenthesised(x);
      case Function::tan:
        return "\\tan" + parenthesised(x);
      case Function::atan:
        return "\\arctan" + parenthesised(x);
      case Function::abs:
        return "\\left|" + print(x) + "\\right|";
      case Function::gamma:
        return "\\Gamma" + parenthesised(x);
      case Function::lgamma:
        return "\\log\\Gamma" + parenthesised(x);
      case Function::digamma:
        return "\\psi^{(0)}" + parenthesised(x);
      case Function::polygamma:
        return "\\psi^{(" + print(e.args()[0]) + ")}" + parenthesised(x);
      case Function::lambertw:
        return "W_0" + parenthesised(x);
    }
    return {};
  }

  bool slash_;
};

}  // namespace

std::string to_latex(const Expression& e) {
  return LatexPrinter(false).print(e);
}

}  // namespace sklar::symbolic
