#include "brdf/basis/fill.hpp"

#include <stdexcept>

namespace sklar::brdf {
namespace {

/// Calls visit(neighbour) for the neighbours of a cell along the axes.
template <class Visit>
void for_each_neighbour(int cell, const Visit& visit) {
  constexpr int kPhi = Grid::phi_d;
  constexpr int kRow = Grid::theta_d * kPhi;
  const int k = cell % kPhi, j = cell / kPhi % Grid::theta_d, i = cell / kRow;
  visit(cell - k + (k + 1) % kPhi);
  visit(cell - k + (k + kPhi - 1) % kPhi);
  if (j > 0) visit(cell - kPhi);
  if (j + 1 < Grid::theta_d) visit(cell + kPhi);
  if (i > 0) visit(cell - kRow);
  if (i + 1 < Grid::theta_h) visit(cell + kRow);
}

/// The masked cells next to valid ones, each once, in the order found.
std::vector<int> border(const std::vector<int>& from, std::vector<std::uint8_t>& seen) {
  std::vector<int> result;
  for (const int cell : from) {
    for_each_neighbour(cell, [&](int next) {
      if (seen[static_cast<std::size_t>(next)] != 0) return;
      seen[static_cast<std::size_t>(next)] = 1;
      result.push_back(next);
    });
  }
  return result;
}

/// @param valid the cells that have a value; those of the layer are not among them.
Rgb neighbour_mean(const MeasuredTable& table, int cell, const std::vector<std::uint8_t>& valid) {
  Rgb sum = Rgb::Zero();
  int count = 0;
  for_each_neighbour(cell, [&](int next) {
    const auto n = static_cast<std::size_t>(next);
    if (valid[n] == 0) return;
    sum += Rgb(table.values[0][n], table.values[1][n], table.values[2][n]);
    ++count;
  });
  return sum / count;
}

}  // namespace

MeasuredTable filled(const MeasuredTable& table) {
  require_table("filled", table);
  MeasuredTable result = table;
  std::vector<std::uint8_t> seen = result.valid;
  std::vector<int> layer;
  for (int cell = 0; cell < Grid::cells; ++cell) {
    if (result.valid[static_cast<std::size_t>(cell)] != 0) layer.push_back(cell);
  }
  for (layer = border(layer, seen); !layer.empty(); layer = border(layer, seen)) {
    std::vector<Rgb> means;
    means.reserve(layer.size());
    for (const int cell : layer) means.push_back(neighbour_mean(result, cell, result.valid));
    for (std::size_t n = 0; n < layer.size(); ++n) {
      const auto cell = static_cast<std::size_t>(layer[n]);
      for (std::size_t channel = 0; channel < 3; ++channel) {
        result.values[channel][cell] = means[n][static_cast<int>(channel)];
      }
      result.valid[cell] = 1;
    }
  }
  return result;
}

}  // namespace sklar::brdf
