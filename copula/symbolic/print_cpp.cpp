#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <stdexcept>

#include "copula/error.hpp"
#include "copula/symbolic/print.hpp"
#include "copula/symbolic/tape.hpp"

namespace sklar::symbolic {

namespace {

constexpr std::size_t kLongest = 60;  // characters of a subexpression written in place

constexpr std::array kReserved{"alignas",      "alignof",
                               "and",          "and_eq",
                               "asm",          "auto",
                               "bitand",       "bitor",
                               "bool",         "break",
                               "case",         "catch",
                               "char",         "char8_t",
                               "char16_t",     "char32_t",
                               "class",        "co_await",
                               "co_return",    "co_yield",
                               "compl",        "concept",
                               "const",        "consteval",
                               "constexpr",    "constinit",
                               "const_cast",   "continue",
                               "decltype",     "default",
                               "delete",       "do",
                               "double",       "else",
                               "enum",         "explicit",
                               "export",       "extern",
                               "false",        "float",
                               "for",          "friend",
                               "goto",         "if",
                               "inline",       "int",
                               "long",         "mutable",
                               "namespace",    "new",
                               "noexcept",     "not",
                               "not_eq",       "nullptr",
                               "operator",     "or",
                               "or_eq",        "private",
                               "protected",    "public",
                               "register",     "reinterpret_cast",
                               "requires",     "return",
                               "short",        "signed",
                               "sizeof",       "static",
                               "static_cast",  "static_assert",
                               "dynamic_cast", "struct",
                               "switch",       "template",
                               "this",         "thread_local",
                               "throw",        "true",
                               "try",          "typedef",
                               "typeid",       "typename",
                               "union",        "unsigned",
                               "using",        "virtual",
                               "void",         "volatile",
                               "wchar_t",      "while",
                               "xor",          "xor_eq",
                               "std"};

bool is_temporary_name(const std::string& name) {
  return name.size() > 1 && name[0] == 'v' && name.find_first_not_of("0123456789", 1) == std::string::npos;
}

std::vector<std::string> cpp_names(const std::vector<std::string>& names, const std::string& function) {
  std::set<std::string> taken(kReserved.begin(), kReserved.end());
  taken.insert(function);
  std::vector<std::string> result;
  for (std::string name : names) {
    while (is_temporary_name(name) || !taken.insert(name).second) name += '_';
    result.push_back(name);
  }
  return result;
}

void require_cpp_name(const std::string& name) {
  const bool letters =
      std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) || c == '_'; });
  if (!letters || name.empty() || std::isdigit(static_cast<unsigned char>(name[0])) ||
      std::find(kReserved.begin(), kReserved.end(), name) != kReserved.end()) {
    throw std::invalid_argument("to_cpp: '" + name + "' is not a C++ name");
  }
}

enum class Level { sum, product, atom };

struct Code {
  std::string text;
  Level level;
};

class CppWriter {
 public:
  CppWriter(const Tape& tape, const std::vector<std::string>& names) : tape_(tape), names_(names) {}

  /// Statements of the body.
  std::string body() {
    count_uses();
    for (std::size_t slot = 0; slot < tape_.instructions().size(); ++slot) {
      Code code = write(tape_.instructions()[slot]);
      const Op op = tape_.instructions()[slot].op;
      const bool leaf = op == Op::constant || op == Op::input;
      const bool last = slot + 1 == tape_.instructions().size();
      if (!leaf && !last && (uses_[slot] > 1 || code.text.size() > kLongest)) {
        const std::string name = "v" + std::to_string(++temporaries_);
        statements_ += "  const double " + name + " = " + code.text + ";\n";
        code = {name, Level::atom};
      }
      codes_.push_back(std::move(code));
    }
    return statements_ + "  return " + codes_[static_cast<std::size_t>(tape_.outputs().front())].text + ";\n";
  }

 private:
  void count_uses() {
    uses_.assign(tape_.instructions().size(), 0);
    for (const Instruction& i : tape_.instructions()) {
      if (i.op == Op::constant || i.op == Op::input) continue;
      const bool twice = i.op == Op::power_near_one || i.op == Op::log_near_one || i.op == Op::log_abs_near_one;
      uses_[static_cast<std::size_t>(i.a)] += twice ? 2 : 1;
      if (has_second(i.op)) uses_[static_cast<std::size_t>(i.b)] += twice ? 2 : 1;
      if (twice) uses_[static_cast<std::size_t>(i.c)] += 1;
    }
  }

  static bool has_second(Op op) {
    return op == Op::add || op == Op::subtract || op == Op::multiply || op == Op::divide || op == Op::power ||
           op == Op::power_near_one;
  }

  [[nodiscard]] const Code& code(std::int32_t slot) const { return codes_[static_cast<std::size_t>(slot)]; }
  [[nodiscard]] const std::string& bare(std::int32_t slot) const { return code(slot).text; }
  [[nodiscard]] std::string at_least(Level level, std::int32_t slot) const {
    return code(slot).level >= level ? bare(slot) : "(" + bare(slot) + ")";
  }
  [[nodiscard]] Code call(const char* function, std::int32_t slot) const {
    return {std::string(function) + "(" + bare(slot) + ")", Level::atom};
  }

  static Code write_constant(const TapeConstant& c) {
    if (!std::isfinite(c.nearest)) throw std::invalid_argument("to_cpp: a constant does not fit in a double");
    const auto literal = [](const std::string& digits) {
      return digits + (digits.find_first_of(".e") == std::string::npos ? ".0" : "");
    };
    const bool short_parts = c.numerator.size() <= 15 && c.denominator.size() <= 15;
    if (c.denominator == "1" && short_parts) return {literal(c.numerator), Level::atom};
    if (short_parts && !c.exact) return {literal(c.numerator) + " / " + literal(c.denominator), Level::product};
    return {literal(sklar::to_text(c.nearest)), Level::atom};
  }

  [[nodiscard]] Code write(const Instruction& i) const {
    switch (i.op) {
      case Op::constant:
        return write_constant(tape_.constants()[static_cast<std::size_t>(i.a)]);
      case Op::input:
        return {names_[static_cast<std::size_t>(i.a)], Level::atom};
      case Op::add:
        return {bare(i.a) + " + " + at_least(Level::product, i.b), Level::sum};
      case Op::subtract:
        return {bare(i.a) + " - " + at_least(Level::product, i.b), Level::sum};
      case Op::multiply:
        return {at_least(Level::product, i.a) + " * " + at_least(Level::atom, i.b), Level::product};
      case Op::divide:
        return {at_least(Level::product, i.a) + " / " + at_least(Level::atom, i.b), Level::product};
      case Op::negate:
        return {"-" + at_least(Level::atom, i.a), Level::sum};
      case Op::whole_power:
        return {"std::pow(" + bare(i.a) + ", " + std::to_string(i.b) + ".0)", Level::atom};
      case Op::power:
        return {"std::pow(" + bare(i.a) + ", " + bare(i.b) + ")", Level::atom};
      case Op::power_near_one:
        return {near_one(i, "std::exp(" + at_least(Level::atom, i.b) + " * std::log1p(" + bare(i.a) + "))",
                         "std::pow(" + bare(i.c) + ", " + bare(i.b) + ")"),
                Level::atom};
      case Op::log_near_one:
        return {near_one(i, "std::log1p(" + bare(i.a) + ")", "std::log(" + bare(i.c) + ")"), Level::atom};
      case Op::log_abs_near_one:
        return {near_one(i, "std::log1p(" + bare(i.a) + ")", "std::log(std::abs(" + bare(i.c) + "))"), Level::atom};
      default:
        return call(function_of(i.op), i.a);
    }
  }

  [[nodiscard]] std::string near_one(const Instruction& i, const std::string& near, const std::string& far) const {
    return "(std::abs(" + bare(i.a) + ") < 0.5 ? " + near + " : " + far + ")";
  }

  static const char* function_of(Op op) {
    switch (op) {
      case Op::sqrt:
        return "std::sqrt";
      case Op::exp:
        return "std::exp";
      case Op::expm1:
        return "std::expm1";
      case Op::log:
        return "std::log";
      case Op::sin:
        return "std::sin";
      case Op::cos:
        return "std::cos";
      case Op::tan:
        return "std::tan";
      case Op::atan:
        return "std::atan";
      case Op::abs:
        return "std::abs";
      case Op::gamma:
        return "std::tgamma";
      case Op::lgamma:
        return "std::lgamma";
      default:
        throw std::invalid_argument("to_cpp: <cmath> has no digamma, polygamma or lambertw");
    }
  }

  const Tape& tape_;
  const std::vector<std::string>& names_;
  std::vector<int> uses_;
  std::vector<Code> codes_;
  std::string statements_;
  int temporaries_ = 0;
};

}  // namespace

std::string to_cpp(const Expression& e, const std::string& name, const std::vector<std::string>& arguments) {
  require_cpp_name(name);
  for (const std::string& argument : arguments) require_cpp_name(argument + "_");
  const Tape tape({e}, arguments);
  const std::vector<std::string> names = cpp_names(arguments, name);
  std::string parameters;
  for (std::size_t j = 0; j < names.size(); ++j) {
    const bool used = std::any_of(tape.instructions().begin(), tape.instructions().end(), [j](const Instruction& i) {
      return i.op == Op::input && static_cast<std::size_t>(i.a) == j;
    });
    parameters += (j ? ", " : "") + (used ? "double " + names[j] : "double /*" + names[j] + "*/");
  }
  return "#include <cmath>\n\ndouble " + name + "(" + parameters + ") {\n" + CppWriter(tape, names).body() + "}\n";
}

}  // namespace sklar::symbolic
