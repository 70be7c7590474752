#pragma once
/// Which coordinates of a copula are replaced by one minus themselves.

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "copula/wide.hpp"

namespace sklar {

/// By default none. One applied after another: operator^.
class Reflection {
 public:
  Reflection() = default;
  explicit Reflection(std::vector<bool> reflected) : reflected_(std::move(reflected)) {}

  [[nodiscard]] static Reflection of_one(std::size_t k) {
    std::vector<bool> reflected(k + 1);
    reflected[k] = true;
    return Reflection(std::move(reflected));
  }

  [[nodiscard]] bool operator[](std::size_t k) const { return k < reflected_.size() && reflected_[k]; }
  [[nodiscard]] bool none() const { return count() == 0; }
  [[nodiscard]] int count() const { return static_cast<int>(std::ranges::count(reflected_, true)); }

  [[nodiscard]] friend Reflection operator^(const Reflection& a, const Reflection& b) {
    std::vector<bool> both(std::max(a.reflected_.size(), b.reflected_.size()));
    for (std::size_t k = 0; k < both.size(); ++k) both[k] = a[k] != b[k];
    return Reflection(std::move(both));
  }

 private:
  std::vector<bool> reflected_;
};

/// 1 - u for u in [0,1], its error 0 where T holds it. @param u a double or, for Widest, a BigFloat.
template <class T, class Number>
[[nodiscard]] T reflected(const Number& u) {
  using Real = decltype(T::value);
  const Real rest = Real(1) - Real(u);
  return {rest, Real(1) - rest == Real(u) ? Real(0) : Real(T::operation() * rest)};  // 1 - rest is exact
}

}  // namespace sklar
