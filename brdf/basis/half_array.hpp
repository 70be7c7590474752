#pragma once
/// Numbers as basis models store them: two bytes each and one scale.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace sklar::brdf {

/// Numbers rounded to half precision (IEEE 754 binary16: 11 significant bits) in units of the largest of them, which is
/// a float: relative error 5e-4 above 6e-5 of the largest, absolute error 3e-8 of it below. They are held as floats, so
/// that reading one costs nothing; bytes() counts what is stored.
class HalfArray {
 public:
  HalfArray() = default;

  /// @param values finite, at most 1e38 in absolute value.
  explicit HalfArray(std::span<const double> values) : values_(values.size()) {
    double largest = 0;
    for (const double value : values) largest = std::max(largest, std::abs(value));
    const auto scale = static_cast<float>(largest);
    if (!(scale > 0)) return;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const auto stored = static_cast<Eigen::half>(static_cast<float>(values[i] / static_cast<double>(scale)));
      values_[i] = static_cast<float>(stored) * scale;
    }
  }

  [[nodiscard]] double operator[](std::size_t i) const { return static_cast<double>(values_[i]); }
  [[nodiscard]] std::size_t size() const { return values_.size(); }
  [[nodiscard]] std::size_t bytes() const { return bytes(values_.size()); }

  /// Of an array of so many numbers.
  [[nodiscard]] static constexpr std::size_t bytes(std::size_t count) { return sizeof(float) + 2 * count; }

 private:
  std::vector<float> values_;
};

}  // namespace sklar::brdf
