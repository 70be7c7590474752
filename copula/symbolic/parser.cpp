#include "copula/symbolic/parser.hpp"

#include <algorithm>
#include <map>

#include "copula/listed.hpp"
#include "copula/symbolic/node.hpp"

namespace sklar::symbolic {

namespace {

constexpr int kMaxDepth = 400;           // nested parentheses and powers; the parser recurses
constexpr long kMaxDecimalPower = 5000;  // of ten, in a decimal number: it is held exactly

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

/// The line around the position and a caret under it.
std::string show_place(std::string_view text, std::size_t position) {
  std::size_t begin = position;
  while (begin > 0 && text[begin - 1] != '\n') --begin;
  const std::size_t end = std::min(text.find('\n', position), text.size());
  std::string line(text.substr(begin, end - begin));
  std::string caret;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (static_cast<unsigned char>(line[i]) < 0x20) line[i] = ' ';
    const bool continuation = (static_cast<unsigned char>(line[i]) & 0xC0) == 0x80;  // UTF-8: no column of its own
    if (begin + i < position && !continuation) caret += ' ';
  }
  return "\n  " + line + "\n  " + caret + "^";
}

using Arguments = std::vector<Expression>;

struct Callable {
  int arity;
  Expression (*make)(const Arguments&);
};

template <Function F>
Expression make_function(const Arguments& args) {
  return apply(F, args);
}

const std::map<std::string, Callable, std::less<>>& callables() {
  static const std::map<std::string, Callable, std::less<>> table{
      {"exp", {1, make_function<Function::exp>}},
      {"log", {1, make_function<Function::log>}},
      {"log1p", {1, [](const Arguments& a) { return log(1 + a[0]); }}},
      {"expm1", {1, [](const Arguments& a) { return exp(a[0]) - 1; }}},
      {"sqrt", {1, [](const Arguments& a) { return sqrt(a[0]); }}},
      {"pow", {2, [](const Arguments& a) { return power(a[0], a[1]); }}},
      {"sin", {1, make_function<Function::sin>}},
      {"cos", {1, make_function<Function::cos>}},
      {"tan", {1, make_function<Function::tan>}},
      {"atan", {1, make_function<Function::atan>}},
      {"abs", {1, make_function<Function::abs>}},
      {"gamma", {1, make_function<Function::gamma>}},
      {"lgamma", {1, make_function<Function::lgamma>}},
      {"digamma", {1, make_function<Function::digamma>}},
      {"polygamma", {2, make_function<Function::polygamma>}},
      {"lambertw", {1, make_function<Function::lambertw>}}};
  return table;
}

class Parser {
 public:
  Parser(std::string_view text, const std::vector<std::string>* allowed) : text_(text), allowed_(allowed) {}

  Expression parse_all() {
    skip_spaces();
    if (at_end()) fail(position_, "an expression was expected, the text is empty");
    const Expression e = parse_sum();
    if (!at_end()) fail(position_, "an operator or the end was expected, got " + found());
    return e;
  }

 private:
  [[noreturn]] void fail(std::size_t position, const std::string& what) const {
    throw ParseError(text_, position, what);
  }

  [[nodiscard]] bool at_end() const { return position_ == text_.size(); }
  [[nodiscard]] char peek() const { return at_end() ? '\0' : text_[position_]; }

  [[nodiscard]] std::string found() const {
    if (at_end()) return "the end";
    const auto byte = static_cast<unsigned char>(peek());
    if (byte < 0x20 || byte > 0x7e) return "a character outside ASCII";
    return "'" + std::string(1, peek()) + "'";
  }

  void skip_spaces() {
    while (!at_end() && (peek() == ' ' || peek() == '\t' || peek() == '\n' || peek() == '\r')) ++position_;
  }

  bool take(char c) {
    if (peek() != c || at_end()) return false;
    ++position_;
    skip_spaces();
    return true;
  }

  void require(char c, const std::string& why) {
    if (!take(c)) fail(position_, "'" + std::string(1, c) + "' was expected" + why + ", got " + found());
  }

  /// Runs a constructor; what it refuses (division by zero, a number of too many digits) is an error at this place of
  /// the text.
  template <class Make>
  Expression checked(std::size_t place, Make make) const {
    try {
      return make();
    } catch (const ParseError&) {
      throw;
    } catch (const std::logic_error& error) {
      fail(place, error.what());
    }
  }

  Expression parse_sum() {
    if (++depth_ > kMaxDepth) fail(position_, "nested too deeply");
    const std::size_t place = position_;
    std::vector<Expression> terms{parse_product()};
    for (;;) {
      if (take('+')) {
        terms.push_back(parse_product());
      } else if (take('-')) {
        terms.push_back(-parse_product());
      } else {
        break;
      }
    }
    --depth_;
    return checked(place, [&] { return sum(terms); });
  }

  Expression parse_product() {
    Expression value = parse_unary();
    for (;;) {
      const std::size_t place = position_;
      if (take('*')) {
        const Expression factor = parse_unary();
        value = checked(place, [&] { return value * factor; });
      } else if (take('/')) {
        const Expression divisor = parse_unary();
        value = checked(place, [&] { return value / divisor; });
      } else {
        return value;
      }
    }
  }

  Expression parse_unary() {
    bool negative = false;
    for (;;) {
      if (take('-')) {
        negative = !negative;
      } else if (!take('+')) {
        break;
      }
    }
    const Expression value = parse_power();
    return negative ? -value : value;
  }

  Expression parse_power() {
    const Expression base = parse_primary();
    const std::size_t place = position_;
    if (!take('^')) return base;
    if (++depth_ > kMaxDepth) fail(position_, "nested too deeply");
    const Expression exponent = parse_unary();
    --depth_;
    return checked(place, [&] { return power(base, exponent); });
  }

  Expression parse_primary() {
    if (is_digit(peek()) || peek() == '.') return parse_number();
    if (is_letter(peek())) return parse_name();
    if (!take('(')) fail(position_, "a number, a symbol, a function or '(' was expected, got " + found());
    const Expression inside = parse_sum();
    require(')', "");
    return inside;
  }

  Expression parse_name() {
    const std::size_t place = position_;
    while (is_letter(peek()) || is_digit(peek())) ++position_;
    const std::string name(text_.substr(place, position_ - place));
    skip_spaces();
    const auto callable = callables().find(name);
    if (callable != callables().end()) return parse_call(place, name, callable->second);
    if (peek() == '(') {
      const auto name_of = [](const auto& entry) { return entry.first; };
      fail(place, "unknown function '" + name + "'; known are " + listed(callables(), name_of));
    }
    if (name == "pi") return 4 * apply(Function::atan, {1});
    if (allowed_ && std::find(allowed_->begin(), allowed_->end(), name) == allowed_->end()) {
      fail(place, "unknown symbol '" + name + "'; " +
                      (allowed_->empty() ? "no symbol is allowed" : "allowed are " + listed(*allowed_)));
    }
    return symbol(name);
  }

  Expression parse_call(std::size_t place, const std::string& name, const Callable& callable) {
    require('(', " after the function " + name);
    Arguments args{parse_sum()};
    while (take(',')) args.push_back(parse_sum());
    if (peek() != ')') fail(position_, "',' or ')' was expected, got " + found());
    if (static_cast<int>(args.size()) != callable.arity) {
      fail(place, name + " takes " + std::to_string(callable.arity) +
                      (callable.arity == 1 ? " argument" : " arguments") + ", got " + std::to_string(args.size()));
    }
    take(')');
    return checked(place, [&] { return callable.make(args); });
  }

  std::string take_digits() {
    const std::size_t begin = position_;
    while (is_digit(peek())) ++position_;
    return std::string(text_.substr(begin, position_ - begin));
  }

  Expression parse_number() {
    const std::size_t place = position_;
    std::string digits = take_digits();
    long shift = 0;
    if (peek() == '.') {
      ++position_;
      const std::string fraction = take_digits();
      if (digits.empty() && fraction.empty()) fail(place, "a digit was expected beside '.'");
      digits += fraction;
      shift -= static_cast<long>(fraction.size());
    }
    shift += parse_exponent();
    if (std::abs(shift) > kMaxDecimalPower || static_cast<long>(digits.size()) > kMaxDecimalPower) {
      fail(place, "a number of more than " + std::to_string(kMaxDecimalPower) + " digits");
    }
    if (is_letter(peek()) || peek() == '.')
      fail(position_, "an operator was expected after the number, got " + found());
    skip_spaces();
    const std::size_t leading = std::min(digits.find_first_not_of('0'), digits.size() - 1);  // else read as octal
    const Integer ten_power = pow(Integer(10), static_cast<unsigned>(std::abs(shift)));
    const Integer whole(digits.substr(leading));
    return number(shift < 0 ? Rational(whole, ten_power) : Rational(Integer(whole * ten_power)));
  }

  /// The decimal exponent, 0 where there is none. A letter e that no digit follows is left alone.
  long parse_exponent() {
    if (peek() != 'e' && peek() != 'E') return 0;
    std::size_t at = position_ + 1;
    const bool negative = at < text_.size() && text_[at] == '-';
    if (at < text_.size() && (text_[at] == '-' || text_[at] == '+')) ++at;
    if (at == text_.size() || !is_digit(text_[at])) return 0;
    const std::size_t place = position_;
    position_ = at;
    const std::string digits = take_digits();
    if (digits.size() > 9) fail(place, "a decimal exponent of more than 9 digits");
    const long value = std::stol(digits);
    return negative ? -value : value;
  }

  std::string_view text_;
  const std::vector<std::string>* allowed_;
  std::size_t position_ = 0;
  int depth_ = 0;
};

}  // namespace

ParseError::ParseError(std::string_view text, std::size_t position, const std::string& what)
    : std::invalid_argument(what + " at position " + std::to_string(position + 1) + show_place(text, position)),
      position_(position) {}

Expression parse(std::string_view text) {
  return Parser(text, nullptr).parse_all();
}

Expression parse(std::string_view text, const std::vector<std::string>& allowed_symbols) {
  return Parser(text, &allowed_symbols).parse_all();
}

}  // namespace sklar::symbolic
