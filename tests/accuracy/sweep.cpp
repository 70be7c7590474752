/// Random cells of one family against the textbook psi in as many digits as it takes: a section of docs/accuracy.md.
/// Run by tests/accuracy.sh.

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <map>
#include <tuple>

#include "copula/error.hpp"
#include "families/registry.hpp"
#include "tests/accuracy/cells.hpp"
#include "tests/support/psi_reference.hpp"

namespace sklar::accuracy {
namespace {

using test::Digits;
using test::PsiReference;

constexpr int kDigits = 400;  // 1 - v of the smallest v
constexpr double kLargestTheta = 1e4;
constexpr double kLogBound = 1e-13;      // |v - e| / max(1, |e|)
constexpr double kHBound = 1e-13;        // |ln v - ln e| / max(1, |ln e| / 20)
constexpr double kInverseBound = 1e-12;  // relative
constexpr double kSmallestNormal = 2.2250738585072014e-308;
constexpr double kSmallestDouble = 4.94e-324;

/// Dimensions and the share of cells, in thousandths.
struct DimensionShare {
  int dim;
  int share;
};
constexpr DimensionShare kDimensions[] = {{2, 400}, {3, 200}, {4, 100}, {5, 100}, {6, 50},  {8, 50},
                                          {10, 50}, {20, 20}, {50, 12}, {75, 10}, {100, 6}, {200, 2}};

Digits larger(const Digits& a, const Digits& b) {
  return a > b ? a : b;
}

double evaluate(const Copula& copula, const Cell& cell) {
  const Points u = Eigen::Map<const Points>(cell.u.data(), 1, cell.dim());
  switch (cell.quantity) {
    case Quantity::log_pdf:
      return copula.log_pdf(u)(0);
    case Quantity::log_cdf:
      return copula.log_cdf(u)(0);
    case Quantity::h:
      return copula.h(u)(0);
    case Quantity::h_upper:
      return copula.h_upper(u)(0);
    case Quantity::h_inv:
      return copula.h_inv(u)(0);
    case Quantity::h_inv_upper:
      return copula.h_inv_upper(u)(0);
  }
  return 0;
}

/// Error as a share of the bound; NaN values are infinitely wrong.
double log_share(double value, const Digits& expected) {
  if (Digits(value) == expected) return 0;
  return static_cast<double>(abs(value - expected) / (kLogBound * larger(1, abs(expected))));
}

double probability_share(double value, const Digits& expected) {
  if (expected < kSmallestNormal) return static_cast<double>(abs(value - expected) / kSmallestDouble);
  const Digits log_expected = log(expected);
  return static_cast<double>(abs(log(Digits(value)) - log_expected) / (kHBound * larger(1, abs(log_expected) / 20)));
}

/// The relative error of v as h sees it: from its slope, or, where h bends, the least step to both sides, from 2^-6 of
/// the bound on, that has p in between. Or how far h(v) is from p at the best double, if that is less.
double inverse_share(const PsiReference& reference, const Cell& cell, double value) {
  const std::span<const double> given(cell.u.data(), cell.u.size() - 1);
  const double p = cell.u.back();
  const Digits v = cell.quantity == Quantity::h_inv_upper ? 1 - Digits(value) : Digits(value);
  if (!(v > 0 && v < 1)) {  // rounded to an end: right if h is beyond p at half the smallest step inside
    const Digits half = value == 0 ? Digits(kSmallestDouble) / 2 : Digits(0x1p-54);
    const bool at_0 = !(v > 0);
    const Digits h = reference.conditional(given, at_0 ? half : 1 - half).value;
    return (at_0 ? h >= p : h <= p) ? 0 : std::numeric_limits<double>::infinity();
  }
  const auto h = reference.conditional(given, v);
  const Digits miss = abs(h.value - p), slope = h.slope * value;
  const Digits relative = miss / (slope * kInverseBound);
  const Digits rounding = larger(4 * std::numeric_limits<double>::epsilon() * value, Digits(kSmallestDouble));
  const Digits best = miss / (1e-14 * p + rounding * h.slope);
  const Digits least = relative < best ? relative : best;
  if (least <= 1) return static_cast<double>(least);
  for (int power = -6; power < 40; ++power) {
    const double share = std::ldexp(1.0, power);
    const Digits step = share * kInverseBound * value;
    const bool below = v <= step || reference.conditional(given, v - step).value <= p;
    if (below && (v + step >= 1 || reference.conditional(given, v + step).value >= p)) return share;
  }
  return std::numeric_limits<double>::infinity();
}

double share_of_bound(const PsiReference& reference, const Cell& cell, double value) {
  const std::span<const double> u(cell.u);
  switch (cell.quantity) {
    case Quantity::log_pdf:
      return log_share(value, reference.log_density(u));
    case Quantity::log_cdf:
      return log_share(value, reference.log_cdf(u));
    case Quantity::h:
      return probability_share(value, reference.conditional(u.first(u.size() - 1), Digits(u.back())).value);
    case Quantity::h_upper:
      return probability_share(value, reference.conditional(u.first(u.size() - 1), Digits(u.back())).complement);
    default:
      return inverse_share(reference, cell, value);
  }
}

struct Worst {
  long cells = 0;
  long failures = 0;
  double share = 0;
  Cell cell{};

  void add(const Cell& next, double next_share) {
    ++cells;
    const bool bad = !(next_share <= 1);
    failures += bad;
    if (cells > 1 && !(next_share > share) && !(bad && share <= 1)) return;
    share = next_share;
    cell = next;
  }
};

std::string short_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", value);
  return text;
}

std::string cell_text(const Cell& cell) {
  std::string text = "theta";
  for (const double value : cell.theta) text += " " + sklar::to_text(value);
  text += ", u";
  constexpr std::size_t kShown = 6;
  for (std::size_t i = 0; i < std::min(cell.u.size(), kShown); ++i) text += " " + sklar::to_text(cell.u[i]);
  return cell.u.size() > kShown ? text + " ..." : text;
}

std::string dim_range(int dim) {
  if (dim <= 3) return std::to_string(dim);
  return dim <= 10 ? "4-10" : dim <= 50 ? "11-50" : "51-200";
}

/// All cells of one family.
class Sweep {
 public:
  explicit Sweep(const FamilyInfo& family) : family_(family) {}

  void run(long cells, std::uint64_t seed) {
    Rng rng(seed);
    for (const auto& [dim, share] : kDimensions) {
      for (long judged = 0; judged < cells * share / 1000;) {
        judged += judge(random_cell(family_, dim, kLargestTheta, rng)) ? 1 : 0;
      }
      std::fprintf(stderr, "%s d = %d done\n", family_.name.c_str(), dim);
    }
  }

  [[nodiscard]] std::string section() const {
    long cells = 0, failures = 0, far = 0;
    for (const auto& [key, worst] : table_) {
      cells += worst.cells;
      failures += worst.failures;
      if (key.dim == "51-200") far += worst.cells;
    }
    std::string text = "## " + family_.title + "\n\n" + std::to_string(cells) + " cells, " + std::to_string(far) +
                       " of them with d > 50; " + std::to_string(failures) + " beyond the bound";
    if (skipped_ > 0) text += "; " + std::to_string(skipped_) + " more outside the support or not resolved by psi";
    text +=
        ".\n\n| quantity | d | region | cells | worst error, share of the bound | where |\n"
        "| --- | --- | --- | --- | --- | --- |\n";
    for (const auto& [key, worst] : table_) {
      text += "| " + std::string(to_text(key.quantity)) + " | " + key.dim + " | " + key.region + " | " +
              std::to_string(worst.cells) + " | " + short_text(worst.share) + " | " + cell_text(worst.cell) + " |\n";
    }
    return text + "\n";
  }

 private:
  struct Key {
    Quantity quantity;
    std::string dim, region;
    friend bool operator<(const Key& a, const Key& b) {
      return std::tie(a.quantity, a.dim, a.region) < std::tie(b.quantity, b.dim, b.region);
    }
  };

  /// False for a cell without an answer: outside the support, or not resolved by psi.
  bool judge(const Cell& cell) {
    const double value = evaluate(*family_.make(cell.dim(), cell.theta), cell);
    double share = 0;
    try {
      const WorkingPrecision precision(kDigits);
      const PsiReference reference(family_, cell.theta);
      const bool conditional = cell.quantity != Quantity::log_pdf && cell.quantity != Quantity::log_cdf;
      const std::span<const double> given(cell.u.data(), cell.u.size() - 1);
      const bool outside = conditional && given.size() > 1 && isinf(reference.log_density(given));
      if (outside) throw std::runtime_error("outside the support");
      share = share_of_bound(reference, cell, value);
    } catch (const std::runtime_error&) {
      ++skipped_;
      return false;
    }
    if (!(share <= 1)) {
      std::fprintf(stderr, "%s %s: %s gives %.17g, %.3g of the bound\n", family_.name.c_str(), to_text(cell.quantity),
                   cell_text(cell).c_str(), value, share);
    }
    table_[{cell.quantity, dim_range(cell.dim()), region(family_, cell)}].add(cell, share);
    return true;
  }

  const FamilyInfo& family_;
  std::map<Key, Worst> table_;
  long skipped_ = 0;
};

}  // namespace
}  // namespace sklar::accuracy

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "usage: accuracy_sweep FAMILY CELLS SEED\n";
    return 2;
  }
  try {
    sklar::accuracy::Sweep sweep(sklar::families::find(argv[1]));
    sweep.run(std::atol(argv[2]), std::strtoull(argv[3], nullptr, 10));
    std::cout << sweep.section();
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "accuracy_sweep: " << error.what() << '\n';
    return 1;
  }
}
