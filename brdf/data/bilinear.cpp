#include "brdf/data/bilinear.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sklar::brdf {

BilinearStack::BilinearStack(int images, int rows, int columns, std::span<const float> values)
    : rows_(rows), columns_(columns), values_(values.begin(), values.end()) {
  if (rows < 2 || columns < 2 || values_.size() != static_cast<std::size_t>(images) * rows * columns) {
    throw std::invalid_argument("BilinearStack: sizes do not agree with the values");
  }
}

double BilinearStack::at(const Vec2& position, const ImageBlend& image) const {
  const Between x = between_clamped(position.x() * (columns_ - 1), columns_);
  const Between y = between_clamped(position.y() * (rows_ - 1), rows_);
  const auto within = [&](int n) {
    const auto along_row = [&](int row) {
      const float* values = values_.data() + (static_cast<std::ptrdiff_t>(n) * rows_ + row) * columns_;
      return mix(static_cast<double>(values[x.low]), static_cast<double>(values[x.high]), x.share);
    };
    return mix(along_row(y.low), along_row(y.high), y.share);
  };
  return mix(image, within);
}

BilinearWarp::BilinearWarp(int images, int rows, int columns, std::span<const float> density)
    : rows_(rows),
      columns_(columns),
      density_(density.begin(), density.end()),
      row_mass_(density.size()),
      mass_(static_cast<std::size_t>(images) * rows) {
  if (rows < 2 || columns < 2 || density_.size() != mass_.size() * columns) {
    throw std::invalid_argument("BilinearWarp: sizes do not agree with the density");
  }
  for (std::ptrdiff_t image = 0; image < images; ++image) {
    const std::ptrdiff_t nodes = static_cast<std::ptrdiff_t>(rows) * columns;
    double* value = density_.data() + image * nodes;
    double* along = row_mass_.data() + image * nodes;
    double* over = mass_.data() + image * rows;
    for (std::ptrdiff_t n = 0; n < nodes; ++n) {
      along[n] = n % columns == 0 ? 0.0 : along[n - 1] + 0.5 * (value[n - 1] + value[n]);
    }
    const auto row_total = [&](std::ptrdiff_t row) { return along[(row + 1) * columns - 1]; };
    for (std::ptrdiff_t row = 1; row < rows; ++row) {
      over[row] = over[row - 1] + 0.5 * (row_total(row - 1) + row_total(row));
    }
    const double total = over[rows - 1];
    if (!(total > 0)) throw std::invalid_argument("BilinearWarp: image " + std::to_string(image) + " has no mass");
    for (std::ptrdiff_t n = 0; n < nodes; ++n) {
      value[n] /= total;
      along[n] /= total;
    }
    for (std::ptrdiff_t row = 0; row < rows; ++row) over[row] /= total;
  }
}

double BilinearWarp::mixed(const std::vector<double>& table, const ImageBlend& image, int row, int column) const {
  const auto at = [&](int n) {
    return table[(static_cast<std::size_t>(n) * rows_ + static_cast<std::size_t>(row)) * columns_ + column];
  };
  return mix(image, at);
}

Vec2 BilinearWarp::invert(const Vec2& position, const ImageBlend& image) const {
  const Between x = between_clamped(position.x() * (columns_ - 1), columns_);
  const Between y = between_clamped(position.y() * (rows_ - 1), rows_);
  const auto over_rows = [&](const std::vector<double>& table, int column) {
    return mix(mixed(table, image, y.low, column), mixed(table, image, y.high, column), y.share);
  };
  const auto mass = [&](int n) { return mass_[static_cast<std::size_t>(n) * rows_ + y.low]; };

  const double left = over_rows(density_, x.low);
  const double right = over_rows(density_, x.high);
  const double part = over_rows(row_mass_, x.low) + x.share * (left + 0.5 * x.share * (right - left));
  const double whole = over_rows(row_mass_, columns_ - 1);
  const double low = mixed(row_mass_, image, y.low, columns_ - 1);
  const double high = mixed(row_mass_, image, y.high, columns_ - 1);
  const double below = mix(image, mass) + y.share * (low + 0.5 * y.share * (high - low));
  return {whole > 0 ? part / whole : position.x(), below};
}

namespace {

/// The interval of a growing table that holds the value; table(n) for n in [0, nodes).
template <class Table>
int interval(int nodes, double value, const Table& table) {
  int low = 0, high = nodes - 1;
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    (table(middle) <= value ? low : high) = middle;
  }
  return low;
}

/// Where the integral of a density that goes from `left` to `right` over a unit interval is `mass`.
double within(double left, double right, double mass) {
  const double root = std::sqrt(std::max(left * left + 2 * (right - left) * mass, 0.0));
  return left + root > 0 ? std::min(2 * mass / (left + root), 1.0) : 0.0;
}

}  // namespace

Vec2 BilinearWarp::sample(const Vec2& s, int image) const {
  const std::size_t first = static_cast<std::size_t>(image) * rows_;
  const auto mass = [&](int row) { return mass_[first + static_cast<std::size_t>(row)]; };
  const auto at = [&](const std::vector<double>& table, int row, int column) {
    return table[(first + static_cast<std::size_t>(row)) * columns_ + column];
  };
  const int row = interval(rows_, s.y(), mass);
  const double y =
      within(at(row_mass_, row, columns_ - 1), at(row_mass_, row + 1, columns_ - 1), std::max(s.y() - mass(row), 0.0));
  const auto over_rows = [&](const std::vector<double>& table, int column) {
    return mix(at(table, row, column), at(table, row + 1, column), y);
  };
  const auto along = [&](int column) { return over_rows(row_mass_, column); };
  const double part = s.x() * along(columns_ - 1);
  const int column = interval(columns_, part, along);
  const double x = within(over_rows(density_, column), over_rows(density_, column + 1), part - along(column));
  return {(column + x) / (columns_ - 1), (row + y) / (rows_ - 1)};
}

}  // namespace sklar::brdf
