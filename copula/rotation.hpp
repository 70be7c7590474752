#pragma once
/// Rotations of families by name.

#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace sklar {

/// The dimensions that a family has.
struct Dimensions {
  int lowest = 2;
  int highest = std::numeric_limits<int>::max();

  [[nodiscard]] bool contains(int dim) const noexcept { return dim >= lowest && dim <= highest; }
  [[nodiscard]] std::string to_text() const;  ///< as in "2", "3 or more", "2 to 20"
};

/// Which coordinates U_i of a copula are replaced by 1 - U_i, by its name:
///   180           all, in any dimension: the survival copula
///   90, 270       the first, the second, in dimension 2
///   u1, u1+u3 ..  those named, in dimension 3 and more
/// The signs of dependence: 180 keeps Kendall's tau, 90 and 270 turn it over; of a list pairs differ. By default none.
class Rotation {
 public:
  Rotation() = default;

  /// @throws std::invalid_argument naming what was found and what is allowed.
  explicit Rotation(std::string_view name);

  [[nodiscard]] const std::string& name() const noexcept { return name_; }  ///< coordinates in order; empty for none
  [[nodiscard]] bool none() const noexcept { return name_.empty(); }
  [[nodiscard]] bool of_all() const noexcept { return coordinates_.empty(); }
  [[nodiscard]] bool of_one_in_a_pair() const noexcept { return dimensions_.highest == 2; }

  [[nodiscard]] Dimensions dimensions() const noexcept { return dimensions_; }

  /// One entry a coordinate: whether it is replaced. Precondition: a dimension among dimensions().
  [[nodiscard]] std::vector<bool> in(int dim) const;

 private:
  std::string name_;
  std::vector<int> coordinates_;  ///< from 1; empty for all, or none
  Dimensions dimensions_;
};

}  // namespace sklar
