#pragma once
/// Bilinear images on the unit square, and the map that flattens one. Nodes at k / (n - 1), ends included; x runs along
/// a row, y over the rows.

#include <span>
#include <vector>

#include "brdf/brdf.hpp"
#include "brdf/data/interpolation.hpp"

namespace sklar::brdf {

/// A stack of images of one size, interpolated within and between images.
class BilinearStack {
 public:
  /// @param values images * rows * columns, row-major; rows and columns >= 2.
  BilinearStack(int images, int rows, int columns, std::span<const float> values);

  /// @param position in the unit square, clamped to it. @param image within [0, images).
  [[nodiscard]] double at(const Vec2& position, const ImageBlend& image) const;

  [[nodiscard]] std::size_t bytes() const { return values_.size() * sizeof(float); }

 private:
  int rows_, columns_;
  std::vector<float> values_;
};

/// The inverse of sampling a stack of bilinear densities: the point of the density's domain that uniforms s would give
/// is mapped back to s, s.y by the marginal of the rows, s.x by the conditional within a row. Each image is normalised
/// first; between images, densities and their integrals are interpolated linearly (the convention of the RGL readers).
class BilinearWarp {
 public:
  /// @param density images * rows * columns, row-major, >= 0, rows and columns >= 2.
  /// @throws std::invalid_argument if an image has no mass.
  BilinearWarp(int images, int rows, int columns, std::span<const float> density);

  /// @param position in the unit square, clamped to it. @return s in the unit square; where the rows hold no mass s.x
  /// is position.x.
  [[nodiscard]] Vec2 invert(const Vec2& position, const ImageBlend& image) const;

  /// The point of one image that invert takes to s. @param s in the unit square.
  [[nodiscard]] Vec2 sample(const Vec2& s, int image) const;

  [[nodiscard]] std::size_t bytes() const {
    return (density_.size() + row_mass_.size() + mass_.size()) * sizeof(double);
  }

 private:
  [[nodiscard]] double mixed(const std::vector<double>& table, const ImageBlend& image, int row, int column) const;

  int rows_, columns_;
  std::vector<double> density_;   ///< images * rows * columns
  std::vector<double> row_mass_;  ///< images * rows * columns: integral of a row up to the node
  std::vector<double> mass_;      ///< images * rows: integral of the rows up to the node
};

}  // namespace sklar::brdf
