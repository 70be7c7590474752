#include "brdf/basis/wavelets.hpp"

#include <algorithm>
#include <bit>
#include <numbers>
#include <stdexcept>

#include "brdf/basis/fill.hpp"
#include "brdf/basis/fit_cells.hpp"
#include "brdf/data/cell_directions.hpp"
#include "brdf/geometry/coordinates.hpp"

namespace sklar::brdf {
namespace {

using Cell = std::array<int, 3>;

/// A box of cells: theta_h, theta_d, phi_d.
struct Box {
  Cell low{0, 0, 0};
  Cell high{Grid::theta_h, Grid::theta_d, Grid::phi_d};  ///< beyond the last

  [[nodiscard]] int side(std::size_t axis) const { return high[axis] - low[axis]; }
  [[nodiscard]] int volume() const { return side(0) * side(1) * side(2); }

  /// The longest side; the last of equal ones.
  [[nodiscard]] std::size_t axis() const {
    std::size_t longest = 2;
    for (const std::size_t other : {1, 0}) {
      if (side(other) > side(longest)) longest = other;
    }
    return longest;
  }
  [[nodiscard]] int middle() const { return (low[axis()] + high[axis()]) / 2; }
  [[nodiscard]] Box half(bool second) const {
    Box result = *this;
    (second ? result.low : result.high)[axis()] = middle();
    return result;
  }
};

std::size_t words(std::size_t coefficients) {
  return (2 * coefficients + 63) / 64;
}

Cell cell_of(const HalfDifference& at) {
  constexpr double kRight = std::numbers::pi / 2;
  const auto inside = [](double position, int cells) { return std::clamp(static_cast<int>(position), 0, cells - 1); };
  return {inside(Grid::theta_h * std::sqrt(at.theta_h / kRight), Grid::theta_h),
          inside(Grid::theta_d * (at.theta_d / kRight), Grid::theta_d),
          inside(Grid::phi_d * (at.phi_d / (2 * kRight)), Grid::phi_d)};
}

}  // namespace

Wavelets::Wavelets(Tree tree) : tree_(std::move(tree)) {
  const std::size_t count = tree_.difference[0].size();
  std::uint32_t ones = 0;
  for (const std::uint64_t word : tree_.halved) {
    ones_before_.push_back(ones);
    ones += static_cast<std::uint32_t>(std::popcount(word));
  }
  bool sound = count > 0 && tree_.halved.size() == words(count) && ones + std::size_t{1} == count;
  for (std::size_t c = 0; c < 3; ++c) {
    sound = sound && tree_.difference[c].size() == count && tree_.rest[c].size() == refined(count);
  }
  if (!sound) throw std::invalid_argument("Wavelets: the bits do not describe the coefficients");
}

std::size_t Wavelets::bytes(std::size_t coefficients) {
  return 3 * sizeof(float) + 3 * HalfArray::bytes(coefficients) + 3 * HalfArray::bytes(refined(coefficients)) +
         words(coefficients) * (sizeof(std::uint64_t) + sizeof(std::uint32_t));
}

Rgb Wavelets::eval(const Vec3& wo, const Vec3& wi) const {
  if (!(wo.z() > 0 && wi.z() > 0)) return Rgb::Zero();
  const Cell cell = cell_of(half_difference(wo, wi));
  Rgb value = tree_.mean.cast<double>();
  Box box;
  std::size_t node = 0;
  while (true) {
    const std::size_t axis = box.axis();
    const bool second = cell[axis] >= box.middle();
    const Box half = box.half(second);
    const double other = 1 - static_cast<double>(half.side(axis)) / box.side(axis);
    for (std::size_t c = 0; c < 3; ++c) {
      const double rest = node < tree_.rest[c].size() ? tree_.rest[c][node] : 0;
      value[static_cast<int>(c)] += (second ? -other : other) * (tree_.difference[c][node] + rest);
    }
    const std::size_t bit = 2 * node + (second ? 1 : 0);
    const std::uint64_t word = tree_.halved[bit / 64];
    if ((word >> (bit % 64) & 1U) == 0) return value;
    const std::uint64_t before = word & ((std::uint64_t{1} << (bit % 64)) - 1);
    node = ones_before_[bit / 64] + static_cast<std::size_t>(std::popcount(before)) + 1;
    box = half;
  }
}

namespace basis::wavelets {
namespace {

/// All coefficients of a table. A box of v cells has v - 1 of them, next to each other: its own, those of the first
/// half, those of the second.
class Transform {
 public:
  explicit Transform(const MeasuredTable& table)
      : table_(filled(table)), valid_(table.valid), difference_(Grid::cells - 1), importance_(Grid::cells - 1) {
    mean_ = descend({}, 0).mean;
  }

  [[nodiscard]] const Rgb& mean() const { return mean_; }

  /// The tree of the `count` most important coefficients.
  [[nodiscard]] Wavelets::Tree tree(std::size_t count) const {
    std::vector<float> order = importance_;
    const auto last = order.begin() + static_cast<std::ptrdiff_t>(count - 1);
    std::nth_element(order.begin(), last, order.end(), std::greater<>());
    struct Node {
      Box box;
      std::size_t index;
    };
    std::vector<Node> nodes = {{{}, 0}};
    std::array<std::vector<double>, 3> kept;
    Wavelets::Tree tree{.mean = mean_.cast<float>(), .difference = {}, .rest = {}, .halved = {}};
    std::vector<std::size_t> bits;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const auto [box, index] = nodes[n];
      for (std::size_t c = 0; c < 3; ++c) {
        kept[c].push_back(static_cast<double>(difference_[index][static_cast<int>(c)]));
      }
      for (const bool second : {false, true}) {
        const Box half = box.half(second);
        const std::size_t child = second ? index + static_cast<std::size_t>(box.half(false).volume()) : index + 1;
        // Above the threshold only, since equal ones may be too many; a box of one cell has no coefficient.
        if (half.volume() == 1 || !(importance_[child] > *last)) continue;
        bits.push_back(2 * n + (second ? 1 : 0));
        nodes.push_back({half, child});
      }
    }
    tree.halved.assign(words(nodes.size()), 0);
    for (const std::size_t bit : bits) tree.halved[bit / 64] |= std::uint64_t{1} << (bit % 64);
    for (std::size_t c = 0; c < 3; ++c) {
      tree.difference[c] = HalfArray(kept[c]);
      kept[c].resize(Wavelets::refined(kept[c].size()));
      for (std::size_t n = 0; n < kept[c].size(); ++n) kept[c][n] -= tree.difference[c][n];
      tree.rest[c] = HalfArray(kept[c]);
    }
    return tree;
  }

 private:
  struct Summary {
    Rgb mean;
    double weight;     ///< sum of cos_i cos_o over the valid cells
    float importance;  ///< the most of the coefficients of the box
  };

  Summary descend(const Box& box, std::size_t index) {
    if (box.volume() == 1) return {value(box.low), weight(box.low), 0};
    const Box first = box.half(false), second = box.half(true);
    const Summary a = descend(first, index + 1);
    const Summary b = descend(second, index + static_cast<std::size_t>(first.volume()));
    const double volume = box.volume(), share = first.volume() / volume;
    const Rgb difference = a.mean - b.mean;
    const double total = a.weight + b.weight;
    const double error = difference.square().sum() * share * (1 - share) * total;
    difference_[index] = difference.cast<float>();
    importance_[index] = std::max({static_cast<float>(error), a.importance, b.importance});
    return {b.mean + share * difference, total, importance_[index]};
  }

  [[nodiscard]] Rgb value(const Cell& cell) const {
    const auto n = static_cast<std::size_t>(Grid::index(cell[0], cell[1], cell[2]));
    return {table_.values[0][n], table_.values[1][n], table_.values[2][n]};
  }

  [[nodiscard]] double weight(const Cell& cell) const {
    if (valid_[static_cast<std::size_t>(Grid::index(cell[0], cell[1], cell[2]))] == 0) return 0;
    const DirectionPair pair = cell_directions(cell[0], cell[1], cell[2]);
    return log_weight(value(cell), std::max(pair.wi.z(), 0.0) * std::max(pair.wo.z(), 0.0)).mean();
  }

  MeasuredTable table_;
  std::vector<std::uint8_t> valid_;
  std::vector<Eigen::Array3f> difference_;
  std::vector<float> importance_;
  Rgb mean_;
};

BrdfPtr fit(const BasisData& data, double max_bytes) {
  require_budget("wavelets", static_cast<double>(Wavelets::bytes(1)), max_bytes);
  std::size_t few = 1, many = Grid::cells;  // the first fits, the second does not or does not exist
  while (many - few > 1) {
    const std::size_t middle = (few + many) / 2;
    (static_cast<double>(Wavelets::bytes(middle)) <= max_bytes ? few : many) = middle;
  }
  return std::make_shared<const Wavelets>(Transform(data.table).tree(few));
}

}  // namespace

BasisInfo info() {
  return {.name = "wavelets",
          .title = "Haar wavelets",
          .source = "Lalonde and Fournier 1997, A Wavelet Representation of Reflectance Functions",
          .fit_unchecked = fit};
}

}  // namespace basis::wavelets
}  // namespace sklar::brdf
