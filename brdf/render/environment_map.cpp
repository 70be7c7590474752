#include "brdf/render/environment_map.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include "brdf/luminance.hpp"

namespace sklar::brdf {
namespace {
using std::numbers::pi;

struct Choice {
  std::size_t index;
  double rest;  ///< of the uniform, stretched over (0,1) again
};

/// An entry in proportion to its part of the running sum. Entries without a part are never chosen.
Choice choose(std::span<const double> running, double uniform) {
  const double target = uniform * running.back();
  const auto entry = std::upper_bound(running.begin(), running.end() - 1, target);
  const double before = entry == running.begin() ? 0.0 : *(entry - 1);
  return {static_cast<std::size_t>(entry - running.begin()), (target - before) / (*entry - before)};
}

/// cos(theta) at the upper edge of a row.
double edge(double row, int height) {
  return std::cos(pi * row / height);
}

Vec3 direction_at(double cos_theta, double share_of_turn) {
  const double sine = std::sqrt(std::max(0.0, 1 - cos_theta * cos_theta));
  const double phi = 2 * pi * (share_of_turn - 0.5);
  return {sine * std::sin(phi), cos_theta, -sine * std::cos(phi)};
}

}  // namespace

EnvironmentMap::EnvironmentMap(Image map) : map_(std::move(map)) {
  if (map_.rgb.empty()) throw std::invalid_argument("environment: the map has no pixels");
  double total = 0;
  for (int row = 0; row < map_.height; ++row) {
    double sum = 0;
    for (int column = 0; column < map_.width; ++column) {
      const Rgb rgb = value({row, column});
      if (!(rgb.minCoeff() >= 0) || !rgb.allFinite()) {
        throw std::invalid_argument("environment: radiance must be finite and not negative, row " +
                                    std::to_string(row + 1) + ", column " + std::to_string(column + 1) + " is not");
      }
      columns_.push_back(sum += luminance(rgb));
    }
    total += sum * (2 * pi / map_.width) * (edge(row, map_.height) - edge(row + 1, map_.height));
    rows_.push_back(total);
  }
}

EnvironmentMap EnvironmentMap::constant(const Rgb& radiance) {
  Image map(1, 1);
  for (int c = 0; c < 3; ++c) map.at(0, 0, c) = static_cast<float>(radiance(c));
  return EnvironmentMap(std::move(map));
}

EnvironmentMap EnvironmentMap::tabulated(const Environment& environment, int rows) {
  Image map(2 * rows, rows);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < 2 * rows; ++column) {
      const Rgb rgb = environment(direction_at(edge(row + 0.5, rows), (column + 0.5) / (2 * rows)));
      for (int c = 0; c < 3; ++c) map.at(row, column, c) = static_cast<float>(rgb(c));
    }
  }
  return EnvironmentMap(std::move(map));
}

EnvironmentMap::Pixel EnvironmentMap::pixel(const Vec3& direction) const {
  const double theta = std::atan2(std::hypot(direction.x(), direction.z()), direction.y());
  const double turn = 0.5 + std::atan2(direction.x(), -direction.z()) / (2 * pi);
  return {std::clamp(static_cast<int>(theta / pi * map_.height), 0, map_.height - 1),
          std::clamp(static_cast<int>(turn * map_.width), 0, map_.width - 1)};
}

Rgb EnvironmentMap::value(const Pixel& pixel) const {
  return {map_.at(pixel.row, pixel.column, 0), map_.at(pixel.row, pixel.column, 1),
          map_.at(pixel.row, pixel.column, 2)};
}

double EnvironmentMap::density(const Rgb& radiance) const {
  return power() > 0 ? luminance(radiance) / power() : 0.0;
}

Rgb EnvironmentMap::radiance(const Vec3& direction) const {
  return value(pixel(direction));
}

double EnvironmentMap::pdf(const Vec3& direction) const {
  return density(radiance(direction));
}

EnvironmentMap::Draw EnvironmentMap::draw(const Vec2& uniforms) const {
  const Choice row = choose(rows_, uniforms.y());
  const auto width = static_cast<std::size_t>(map_.width);
  const Choice column = choose(std::span(columns_).subspan(row.index * width, width), uniforms.x());
  const Pixel chosen{static_cast<int>(row.index), static_cast<int>(column.index)};
  const double upper = edge(chosen.row, map_.height), lower = edge(chosen.row + 1, map_.height);
  const Rgb rgb = value(chosen);
  return {direction_at(upper + (lower - upper) * row.rest, (chosen.column + column.rest) / map_.width), rgb,
          density(rgb)};
}

}  // namespace sklar::brdf
