#include "copula/rotation.hpp"

#include <algorithm>
#include <charconv>
#include <stdexcept>

namespace sklar {

namespace {

[[noreturn]] void refuse(std::string_view name) {
  throw std::invalid_argument("unknown rotation '@" + std::string(name) +
                              "'; allowed: @180, in dimension 2 @90 and @270, in more dimensions coordinates as in "
                              "@u1 and @u1+u3");
}

/// The k of each uk between plus signs, in order.
std::vector<int> parse_coordinates(std::string_view name) {
  std::vector<int> coordinates;
  for (std::size_t begin = 0; begin <= name.size();) {
    const std::string_view item = name.substr(begin, name.find('+', begin) - begin);
    const char* end = item.data() + item.size();
    int k = 0;
    if (!item.starts_with('u')) refuse(name);
    const auto [stop, error] = std::from_chars(item.data() + 1, end, k);
    if (error != std::errc() || stop != end || k < 1 || std::ranges::count(coordinates, k) > 0) refuse(name);
    coordinates.push_back(k);
    begin += item.size() + 1;
  }
  std::ranges::sort(coordinates);
  return coordinates;
}

std::string to_name(const std::vector<int>& coordinates) {
  std::string name;
  for (const int k : coordinates) name += (name.empty() ? "u" : "+u") + std::to_string(k);
  return name;
}

}  // namespace

std::string Dimensions::to_text() const {
  if (lowest == highest) return std::to_string(lowest);
  const bool bounded = highest < std::numeric_limits<int>::max();
  return std::to_string(lowest) + (bounded ? " to " + std::to_string(highest) : " or more");
}

Rotation::Rotation(std::string_view name) : name_(name) {
  if (name == "180") return;
  if (name == "90" || name == "270") {
    coordinates_ = {name == "90" ? 1 : 2};
    dimensions_ = {2, 2};
    return;
  }
  coordinates_ = parse_coordinates(name);
  name_ = to_name(coordinates_);
  dimensions_.lowest = std::max(3, coordinates_.back());
}

std::vector<bool> Rotation::in(int dim) const {
  std::vector<bool> reflected(static_cast<std::size_t>(dim), !none() && of_all());
  for (const int k : coordinates_) reflected[static_cast<std::size_t>(k - 1)] = true;
  return reflected;
}

}  // namespace sklar
