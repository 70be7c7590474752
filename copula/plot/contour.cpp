#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "copula/plot/plot.hpp"

namespace sklar::plot {
namespace {

struct Corner {
  double x, y, value;
};

/// The cell's corners in the order of its boundary, and where the level crosses the sides.
class Cell {
 public:
  Cell(const std::array<Corner, 4>& corners, double level) {
    for (std::size_t side = 0; side < 4; ++side) {
      const Corner& from = corners[side];
      const Corner& to = corners[(side + 1) % 4];
      if (!std::isfinite(from.value)) finite_ = false;
      if ((from.value >= level) == (to.value >= level)) continue;
      const double t = (level - from.value) / (to.value - from.value);
      crossings_[count_++] = {from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)};
    }
    // All four sides crossed: the two pieces go around the corners on the other side of the level than the middle is.
    const double middle = (corners[0].value + corners[1].value + corners[2].value + corners[3].value) / 4;
    around_first_ = (middle >= level) == (corners[1].value >= level) ? 1 : 0;
  }

  void add_to(Line& line) const {
    if (!finite_) return;
    for (std::size_t piece = 0; 2 * piece < count_; ++piece) {
      const std::size_t first = 2 * piece + (count_ == 4 ? around_first_ : 0);
      for (const std::size_t end : {first, first + 1}) {
        line.x.push_back(crossings_[end % 4].first);
        line.y.push_back(crossings_[end % 4].second);
      }
      line.x.push_back(std::numeric_limits<double>::quiet_NaN());
      line.y.push_back(std::numeric_limits<double>::quiet_NaN());
    }
  }

 private:
  std::array<std::pair<double, double>, 4> crossings_{};
  std::size_t count_ = 0;
  std::size_t around_first_ = 0;
  bool finite_ = true;
};

}  // namespace

Line contour(const std::vector<double>& x, const std::vector<double>& y, const Eigen::ArrayXXd& values, double level) {
  if (values.rows() != static_cast<Eigen::Index>(y.size()) || values.cols() != static_cast<Eigen::Index>(x.size())) {
    throw std::invalid_argument("contour: values must have one row for each y and one column for each x");
  }
  Line line;
  for (std::size_t i = 0; i + 1 < y.size(); ++i) {
    for (std::size_t j = 0; j + 1 < x.size(); ++j) {
      const auto corner = [&](std::size_t row, std::size_t column) {
        const double value = values(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column));
        return Corner{x[column], y[row], value};
      };
      Cell({corner(i, j), corner(i, j + 1), corner(i + 1, j + 1), corner(i + 1, j)}, level).add_to(line);
    }
  }
  return line;
}

}  // namespace sklar::plot
