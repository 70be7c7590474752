#include "tests/support/psi_reference.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>

#include "copula/symbolic/derivative.hpp"
#include "copula/symbolic/parser.hpp"

namespace sklar::test {

namespace {

constexpr double kAgreement = 1e-30;  // relative
constexpr double kLogarithm = 1;      // below this size absolute
constexpr double kProbability = 1e-310;

using symbolic::Expression;
using symbolic::Kind;

bool is_whole(const Expression& e) {
  return e.is_number() && symbolic::power(-1, e).is_number() && symbolic::power(-1, 2 * e) == Expression(1);
}

// psi = 0 where one of these is not positive: the bases in t of powers that are not whole.
void add_bases(const Expression& e, std::vector<Expression>& bases) {
  static const Expression t = symbolic::symbol("t");
  if (e.kind() == Kind::power && e.args()[0].depends_on(t) && !is_whole(e.args()[1])) bases.push_back(e.args()[0]);
  for (const Expression& arg : e.args()) add_bases(arg, bases);
}

std::vector<Digits> in_digits(std::span<const double> u) {
  return {u.begin(), u.end()};
}

template <class Compute>
std::vector<Digits> with_digits(int digits, const Compute& compute) {
  const WorkingPrecision precision(digits);
  return compute();
}

// compute() in ever wider numbers until two widths agree, relative to the result or to `floor` if that is larger.
template <class Compute>
std::vector<Digits> in_two_widths(double floor, const Compute& compute) {
  for (int digits = 100; digits <= 6400; digits *= 2) {
    const std::vector<Digits> narrow = with_digits(digits, compute);
    std::vector<Digits> wider = with_digits(digits + digits / 2, compute);
    const WorkingPrecision precision(digits);
    const bool resolved = pow(Digits(10), -digits) < floor;  // else a difference may vanish unseen
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

/// psi and its derivatives as tapes, each made when first asked for. Not safe to share between threads.
class PsiReference::Formulas {
 public:
  explicit Formulas(const FamilyInfo& family)
      : psi_(symbolic::parse(family.psi)), derivatives_(psi_, symbolic::symbol("t")) {
    for (const ParameterInfo& parameter : family.parameters) parameters_.push_back(parameter.name);
    add_bases(psi_, bases_);
  }

  /// kSupport: all bases; else the derivative of this order.
  const symbolic::SplitTape& tape(int which) {
    const auto known = tapes_.find(which);
    if (known != tapes_.end()) return known->second;
    const auto outputs = which == kSupport ? bases_ : std::vector{derivatives_(which)};
    return tapes_.try_emplace(which, outputs, "t", parameters_).first->second;
  }

  static constexpr int kSupport = -1;

 private:
  Expression psi_;
  symbolic::Derivatives derivatives_;
  std::vector<std::string> parameters_;
  std::vector<Expression> bases_;
  std::map<int, symbolic::SplitTape> tapes_;
};

PsiReference::PsiReference(const FamilyInfo& family, Theta theta) : theta_(std::move(theta)) {
  static std::map<std::string, std::shared_ptr<Formulas>> known;  // by psi: derivatives of high order take seconds
  std::shared_ptr<Formulas>& formulas = known[family.psi];
  if (!formulas) formulas = std::make_shared<Formulas>(family);
  formulas_ = formulas;
}

symbolic::SplitTape::Values<Digits> PsiReference::run(int which, const Digits& t) const {
  const symbolic::SplitTape& tape = formulas_->tape(which);
  const auto [place, added] = prepared_.try_emplace({which, WorkingPrecision::bits()});
  if (added) place->second = tape.prepare<Digits>(theta_);
  return tape.run<Digits>(place->second, t);
}

// (x)_+ of all bases: psi is 0 where one is not positive.
bool PsiReference::in_support(const Digits& t) const {
  const auto bases = run(Formulas::kSupport, t);
  for (std::size_t i = 0; i < bases.size(); ++i) {
    if (!(bases[i] > 0)) return false;
  }
  return true;
}

Digits PsiReference::derivative(int order, const Digits& t) const {
  return in_support(t) ? run(order, t)[0] : Digits(0);
}

// log|psi^(order)(t)|; a derivative of 0 inside the support has lost all its digits.
Digits PsiReference::log_abs_derivative(int order, const Digits& t) const {
  if (!in_support(t)) return -std::numeric_limits<Digits>::infinity();
  const Digits value = abs(run(order, t)[0]);
  return value > 0 ? log(value) : std::numeric_limits<Digits>::quiet_NaN();
}

// Newton for log(-log psi) as a function of log t, nearly a straight line for most generators, inside a bracket; with
// bisection in turn where that does not settle, as next to the end of a bounded support.
Digits PsiReference::log_inverse(const Digits& target, Digits x) const {
  constexpr int kPatience = 40;
  const Digits epsilon = std::numeric_limits<Digits>::epsilon();
  // A residual this small becomes its square in the next step, times at most |log psi|: all the digits there are.
  const Digits settled = sqrt(epsilon) / 1000;
  Digits below = -1e9, above = 1e9;
  for (int step = 0; above - below > epsilon * (1 + abs(x)); ++step) {
    const Digits t = exp(x);
    const Digits psi = derivative(0, t);
    const bool outside = !(psi > 0 && psi < 1);  // beyond the support, or too near its ends for this width
    const Digits minus_log = outside ? Digits(0) : Digits(-log(psi));
    const Digits excess = outside ? Digits(psi < 1 ? 1 : -1) : Digits(log(minus_log) - target);
    (excess > 0 ? above : below) = x;
    const Digits next = outside ? x : Digits(x + excess * psi * minus_log / (t * derivative(1, t)));
    if (!outside && abs(excess) <= settled) return next;
    const bool newton = next > below && next < above && (step < kPatience || step % 2 != 0);
    x = newton ? next : Digits((below + above) / 2);
  }
  return x;  // the widths will not agree
}

// Most steps in few digits.
Digits PsiReference::inverse(const Digits& u) const {
  constexpr int kFewDigits = 40;
  Digits start = 0;
  {
    const WorkingPrecision precision(kFewDigits);
    start = log_inverse(log(-log(u)), 0);
  }
  return exp(log_inverse(log(-log(u)), start));
}

Digits PsiReference::sum_of_inverses(std::span<const Digits> u) const {
  Digits t = 0;
  for (const Digits& value : u) t += inverse(value);
  return t;
}

Digits PsiReference::log_abs_dpsi(int k, double t) const {
  return in_two_widths(kLogarithm, [&] { return std::vector<Digits>{log_abs_derivative(k, Digits(t))}; })[0];
}

Digits PsiReference::log_density(std::span<const double> u) const {
  return log_density(in_digits(u));
}

Digits PsiReference::log_density(std::span<const Digits> u) const {
  return in_two_widths(kLogarithm, [&] {
    Digits t = 0, weights = 0;
    for (const Digits& value : u) {
      const Digits part = inverse(value);
      t += part;
      weights += log_abs_derivative(1, part);
    }
    return std::vector<Digits>{log_abs_derivative(static_cast<int>(u.size()), t) - weights};
  })[0];
}

Digits PsiReference::log_cdf(std::span<const double> u) const {
  const std::vector<Digits> point = in_digits(u);
  return in_two_widths(kLogarithm, [&] { return std::vector<Digits>{log(derivative(0, sum_of_inverses(point)))}; })[0];
}

Digits PsiReference::volume(std::span<const double> lower, std::span<const double> upper) const {
  return volume(in_digits(lower), in_digits(upper));
}

Digits PsiReference::volume(std::span<const Digits> lower, std::span<const Digits> upper) const {
  return in_two_widths(kProbability, [&] {
    std::vector<Digits> low, high;
    for (const Digits& value : lower) low.push_back(value == 0 ? Digits(-1) : inverse(value));  // -1: C is 0
    for (const Digits& value : upper) high.push_back(value == 1 ? Digits(0) : inverse(value));
    Digits total = 0;
    for (std::size_t corner = 0; corner < std::size_t{1} << lower.size(); ++corner) {
      Digits t = 0;
      bool odd = false, zero = false;
      for (std::size_t i = 0; i < lower.size(); ++i) {
        const bool at_low = (corner >> i & 1) != 0;
        t += at_low ? low[i] : high[i];
        odd = odd != at_low;
        zero = zero || (at_low && low[i] < 0);
      }
      if (zero) continue;
      const Digits value = t == 0 ? Digits(1) : derivative(0, t);
      total += odd ? Digits(-value) : value;
    }
    return std::vector<Digits>{total};
  })[0];
}

PsiReference::Probability PsiReference::kendall(int dim, double v) const {
  const std::vector<Digits> result = in_two_widths(kProbability, [&] {
    const Digits r = inverse(Digits(v));
    Digits sum = derivative(0, r), scale = 1;
    for (int k = 1; k < dim; ++k) {
      scale *= r / k;
      sum += scale * abs(derivative(k, r));
    }
    return std::vector<Digits>{sum, 1 - sum};
  });
  return {result[0], result[1]};
}

Digits PsiReference::tau_integrand(double v) const {
  return in_two_widths(kProbability, [&] {
    const Digits t = inverse(Digits(v));
    return std::vector<Digits>{t * derivative(1, t)};
  })[0];
}

PsiReference::Conditional PsiReference::conditional(std::span<const double> given, const Digits& v) const {
  return conditional(in_digits(given), v);
}

PsiReference::Conditional PsiReference::conditional(std::span<const Digits> given, const Digits& v) const {
  const std::vector<Digits> result = in_two_widths(kProbability, [&] {
    const int j = static_cast<int>(given.size());
    const Digits before = sum_of_inverses(given), step = inverse(v);
    const Digits scale = derivative(j, before);
    const Digits h = derivative(j, before + step) / scale;
    return std::vector<Digits>{h, 1 - h, derivative(j + 1, before + step) / scale / derivative(1, step)};
  });
  return {result[0], result[1], result[2]};
}

}  // namespace sklar::test
