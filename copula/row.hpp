#pragma once
/// A row of coordinates as the formulas take it: in any of the number types, with some coordinates reflected.

#include <array>
#include <span>
#include <vector>

#include "copula/reflection.hpp"

namespace sklar {

/// Views; neither may outlive what it looks at.
struct Row {
  std::span<const double> u;
  const Reflection* reflection = nullptr;  ///< nullptr: none

  [[nodiscard]] bool is_reflected(std::size_t k) const { return reflection != nullptr && (*reflection)[k]; }
};

/// The row in T, without heap allocation up to dimension 16.
template <class T>
class RowOf {
 public:
  explicit RowOf(const Row& row) : size_(row.u.size()), large_(size_ > kOnStack ? size_ : 0) {
    T* next = size_ > kOnStack ? large_.data() : small_.data();
    for (std::size_t k = 0; k < size_; ++k) next[k] = row.is_reflected(k) ? reflected<T>(row.u[k]) : T(row.u[k]);
  }

  [[nodiscard]] std::span<const T> all() const { return {size_ > kOnStack ? large_.data() : small_.data(), size_}; }
  [[nodiscard]] std::span<const T> given() const { return all().first(size_ - 1); }
  [[nodiscard]] const T& last() const { return all().back(); }

 private:
  static constexpr std::size_t kOnStack = 16;

  std::size_t size_;
  std::array<T, kOnStack> small_;
  std::vector<T> large_;
};

}  // namespace sklar
