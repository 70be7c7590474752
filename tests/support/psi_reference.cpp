#include "tests/support/psi_reference.hpp"

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <string>
#include <string_view>

#include "tests/support/jet.hpp"

namespace sklar::test {

namespace {

using DigitsJet = Jet<Digits>;

constexpr double kAgreement = 1e-30;  // relative
constexpr double kLogarithm = 1;      // below this size absolute
constexpr double kProbability = 1e-310;

// A recursive-descent reader of psi: numbers, t, parameters, + - * / ^, exp, log, parentheses. x^a means (x)_+^a.
class Expression {
 public:
  Expression(std::string_view text, const FamilyInfo& family, const Theta& theta, const DigitsJet& t)
      : text_(text), family_(family), theta_(theta), t_(t) {}

  DigitsJet read() {
    const DigitsJet value = sum();
    if (at_ != text_.size()) fail();
    return value;
  }

 private:
  DigitsJet constant(const Digits& value) const { return {t_.order(), value}; }

  DigitsJet sum() {
    DigitsJet value = accept('-') ? constant(0) - product() : product();
    for (;;) {
      if (accept('+')) {
        value = value + product();
      } else if (accept('-')) {
        value = value - product();
      } else {
        return value;
      }
    }
  }

  DigitsJet product() {
    DigitsJet value = power();
    for (;;) {
      if (accept('*')) {
        value = value * power();
      } else if (accept('/')) {
        value = value / power();
      } else {
        return value;
      }
    }
  }

  DigitsJet power() {
    const DigitsJet base = primary();
    return accept('^') ? pow(base, power()) : base;
  }

  DigitsJet primary() {
    if (accept('-')) return constant(0) - power();
    if (accept('(')) return closed(sum());
    if (at_ < text_.size() && std::isdigit(static_cast<unsigned char>(text_[at_])) != 0) {
      return constant(
          Digits(take([](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.'; })));
    }
    const std::string name = take([](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; });
    if (name == "t") return t_;
    if (name == "exp" && accept('(')) return exp(closed(sum()));
    if (name == "log" && accept('(')) return log(closed(sum()));
    for (std::size_t i = 0; i < theta_.size(); ++i) {
      if (family_.parameters[i].name == name) return constant(Digits(theta_[i]));
    }
    fail();
  }

  DigitsJet closed(DigitsJet value) {
    if (!accept(')')) fail();
    return value;
  }

  bool accept(char c) {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
    if (at_ == text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }

  template <class Belongs>
  std::string take(const Belongs& belongs) {
    const std::size_t first = at_;
    while (at_ < text_.size() && belongs(text_[at_])) ++at_;
    return std::string(text_.substr(first, at_ - first));
  }

  [[noreturn]] void fail() const {
    throw std::runtime_error("PsiReference: cannot read '" + std::string(text_) + "' at " + std::to_string(at_));
  }

  std::string_view text_;
  const FamilyInfo& family_;
  const Theta& theta_;
  const DigitsJet& t_;
  std::size_t at_ = 0;
};

// compute() in ever wider numbers until two widths agree, relative to the result or to `floor` if that is larger.
template <class Compute>
std::vector<Digits> in_two_widths(double floor, const Compute& compute) {
  for (unsigned digits = 100; digits <= 1600; digits *= 2) {
    Digits::default_precision(digits);
    const std::vector<Digits> narrow = compute();
    Digits::default_precision(digits + digits / 2);
    std::vector<Digits> wider = compute();
    const bool resolved = pow(Digits(10), -static_cast<int>(digits)) < floor;  // else a difference may vanish unseen
    const auto agree = [&](const Digits& a, const Digits& b) {
      const Digits size = abs(b);
      if (b == 0 && !resolved) return false;
      return a == b || abs(a - b) <= kAgreement * (size > floor ? size : Digits(floor));
    };
    if (std::equal(narrow.begin(), narrow.end(), wider.begin(), agree)) return wider;
  }
  throw std::runtime_error("PsiReference: no two widths agree");
}

}  // namespace

std::vector<Digits> PsiReference::derivatives(std::size_t order, const Digits& t) const {
  const DigitsJet variable = DigitsJet::variable(order, t);
  const DigitsJet psi = Expression(family_.psi, family_, theta_, variable).read();
  std::vector<Digits> result;
  Digits factorial = 1;
  for (std::size_t k = 0; k <= order; ++k) {
    if (k > 1) factorial *= k;
    result.push_back(psi.coefficient(k) * factorial);
  }
  return result;
}

// Newton for log(-log psi) as a function of log t, nearly a straight line for most generators, inside a bracket; by
// bisection for a while where that does not settle.
Digits PsiReference::inverse(const Digits& u) const {
  constexpr int kPatience = 40, kBisections = 60, kMaxSteps = 200;
  const Digits target = log(-log(u));
  // A step this small leaves an error near its square: all the digits that cancellation in psi leaves.
  const Digits resolution = pow(Digits(10), -static_cast<int>(Digits::default_precision()) / 2);
  Digits x = 0, below = -1e9, above = 1e9;
  for (int step = 0; step < kMaxSteps; ++step) {
    const Digits t = exp(x);
    const std::vector<Digits> psi = derivatives(1, t);
    const bool outside = !(psi[0] > 0 && psi[0] < 1);  // beyond the support, or too near its ends for this width
    const Digits minus_log = outside ? Digits(0) : Digits(-log(psi[0]));
    const Digits excess = outside ? Digits(psi[0] < 1 ? 1 : -1) : Digits(log(minus_log) - target);
    (excess > 0 ? above : below) = x;
    const Digits next = outside ? x : Digits(x + excess * psi[0] * minus_log / (t * psi[1]));
    if (!outside && abs(next - x) <= resolution * (1 + abs(x))) return exp(next);
    const bool newton = next > below && next < above && (step < kPatience || step >= kPatience + kBisections);
    x = newton ? next : Digits((below + above) / 2);
  }
  return exp(x);  // the widths will not agree
}

Digits PsiReference::sum_of_inverses(std::span<const double> u) const {
  Digits t = 0;
  for (const double value : u) t += inverse(Digits(value));
  return t;
}

Digits PsiReference::log_abs_dpsi(int k, double t) const {
  const auto order = static_cast<std::size_t>(k);
  return in_two_widths(kLogarithm,
                       [&] { return std::vector<Digits>{log(abs(derivatives(order, Digits(t))[order]))}; })[0];
}

Digits PsiReference::log_density(std::span<const double> u) const {
  return in_two_widths(kLogarithm, [&] {
    Digits t = 0, weights = 0;
    for (const double value : u) {
      const Digits part = inverse(Digits(value));
      t += part;
      weights += log(abs(derivatives(1, part)[1]));
    }
    return std::vector<Digits>{log(abs(derivatives(u.size(), t)[u.size()])) - weights};
  })[0];
}

Digits PsiReference::log_cdf(std::span<const double> u) const {
  return in_two_widths(kLogarithm, [&] { return std::vector<Digits>{log(derivatives(0, sum_of_inverses(u))[0])}; })[0];
}

Digits PsiReference::volume(std::span<const double> lower, std::span<const double> upper) const {
  return in_two_widths(kProbability, [&] {
    std::vector<Digits> low, high;
    for (const double value : lower) low.push_back(inverse(Digits(value)));
    for (const double value : upper) high.push_back(inverse(Digits(value)));
    Digits total = 0;
    for (std::size_t corner = 0; corner < std::size_t{1} << lower.size(); ++corner) {
      Digits t = 0;
      bool odd = false;
      for (std::size_t i = 0; i < lower.size(); ++i) {
        const bool at_low = (corner >> i & 1) != 0;
        t += at_low ? low[i] : high[i];
        odd = odd != at_low;
      }
      const Digits value = derivatives(0, t)[0];
      total += odd ? Digits(-value) : value;
    }
    return std::vector<Digits>{total};
  })[0];
}

Digits PsiReference::tau_integrand(double v) const {
  return in_two_widths(kProbability, [&] {
    const Digits t = inverse(Digits(v));
    return std::vector<Digits>{t * derivatives(1, t)[1]};
  })[0];
}

PsiReference::Conditional PsiReference::conditional(std::span<const double> given, const Digits& v) const {
  const std::vector<Digits> result = in_two_widths(kProbability, [&] {
    const std::size_t j = given.size();
    const Digits before = sum_of_inverses(given), step = inverse(v);
    const Digits scale = derivatives(j, before)[j];
    const std::vector<Digits> here = derivatives(j + 1, before + step);
    const Digits h = here[j] / scale;
    return std::vector<Digits>{h, 1 - h, here[j + 1] / scale / derivatives(1, step)[1]};
  });
  return {result[0], result[1], result[2]};
}

}  // namespace sklar::test
