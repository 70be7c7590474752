#include "brdf/data/cell_directions.hpp"

#include <array>
#include <cmath>

namespace sklar::brdf {
namespace {

struct Turn {
  double sine, cosine;
};

template <std::size_t Count>
std::array<Turn, Count> turns(double (*centre)(int)) {
  std::array<Turn, Count> all;
  for (std::size_t n = 0; n < Count; ++n) {
    const double angle = centre(static_cast<int>(n));
    all[n] = {std::sin(angle), std::cos(angle)};
  }
  return all;
}

}  // namespace

DirectionPair cell_directions(int theta_h, int theta_d, int phi_d) {
  static const auto half = turns<Grid::theta_h>(Grid::theta_h_centre);
  static const auto polar = turns<Grid::theta_d>(Grid::theta_d_centre);
  static const auto azimuth = turns<Grid::phi_d>(Grid::phi_d_centre);
  const Turn& h = half[static_cast<std::size_t>(theta_h)];
  const Turn& d = polar[static_cast<std::size_t>(theta_d)];
  const Turn& p = azimuth[static_cast<std::size_t>(phi_d)];
  const double x = d.sine * p.cosine;
  const double y = d.sine * p.sine;
  const auto turned = [&](double along, double across) -> Vec3 {
    return {h.cosine * along + h.sine * d.cosine, across, h.cosine * d.cosine - h.sine * along};
  };
  return {.wi = turned(x, y), .wo = turned(-x, -y)};
}

}  // namespace sklar::brdf
