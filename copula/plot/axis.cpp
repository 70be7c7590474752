#include "copula/plot/axis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "copula/error.hpp"

namespace sklar::plot {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

double scaled(Scale scale, double value) {
  switch (scale) {
    case Scale::logarithmic:
      return value > 0 ? std::log10(value) : kNan;
    case Scale::square_root:
      return value >= 0 ? std::sqrt(value) : kNan;
    case Scale::digits:
      return value > 0 && value < 1 ? -std::log10(-std::log10(value)) : kNan;
    case Scale::linear:
      break;
  }
  return value;
}

/// The smallest of 1, 2, 5 times a power of ten that cuts the range into at most `parts`.
double tick_step(double range, int parts) {
  const double rough = range / parts;
  const double decade = std::pow(10, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * decade >= rough * (1 - 1e-9)) return factor * decade;
  }
  return 10 * decade;
}

/// The multiples of a step in a range.
std::vector<double> round_numbers(double low, double high, int parts) {
  const double step = tick_step(high - low, parts);
  const auto first = static_cast<long long>(std::ceil(low / step - 1e-9));
  const auto last = static_cast<long long>(std::floor(high / step + 1e-9));
  // A step below 1 is 1 / inverse: the quotient, unlike the product, is the double nearest to the decimal.
  const double inverse = std::round(1 / step);
  const bool divides = step < 1 && std::abs(inverse * step - 1) < 1e-9;
  std::vector<double> numbers;
  for (long long n = first; n <= last; ++n) {
    const auto count = static_cast<double>(n);
    numbers.push_back(divides ? count / inverse : count * step);
  }
  return numbers;
}

/// The exponent of the unit of an axis.
int unit_power(const Axis& axis) {
  if (!axis.ticks.empty() || axis.scale == Scale::digits || axis.scale == Scale::logarithmic) return 0;
  const std::vector<double> numbers = round_numbers(axis.low, axis.high, kTickParts);
  const bool plain = std::none_of(numbers.begin(), numbers.end(),
                                  [](double number) { return to_text(number).find('e') != std::string::npos; });
  if (plain) return 0;
  const double greatest = std::max(std::abs(numbers.front()), std::abs(numbers.back()));
  return 3 * static_cast<int>(std::floor(std::log10(greatest) / 3 + 1e-9));
}

/// With minus signs in place of hyphens.
std::string with_minus_signs(std::string text) {
  for (auto at = text.find('-'); at != std::string::npos; at = text.find('-')) text.replace(at, 1, "\u2212");
  return text;
}

}  // namespace

Axis fitted(Axis axis, const std::vector<double>& values) {
  if (axis.low != axis.high) return axis;
  axis.low = std::numeric_limits<double>::infinity();
  axis.high = -axis.low;
  for (const double value : values) {
    if (!std::isfinite(scaled(axis.scale, value))) continue;
    axis.low = std::min(axis.low, value);
    axis.high = std::max(axis.high, value);
  }
  if (axis.low > axis.high) axis.low = axis.high = axis.scale == Scale::logarithmic ? 1 : 0;
  if (axis.low == axis.high) {
    const double value = axis.low;
    axis.low = axis.scale == Scale::linear ? value - 0.5 : value / 2;
    axis.high = axis.scale == Scale::logarithmic ? value * 2 : value + 0.5;
  }
  if (axis.scale == Scale::linear) {
    const double step = tick_step(axis.high - axis.low, kTickParts);
    axis.low = std::floor(axis.low / step + 1e-9) * step;
    axis.high = std::ceil(axis.high / step - 1e-9) * step;
  }
  return axis;
}

double axis_position(const Axis& axis, double value) {
  const double low = scaled(axis.scale, axis.low);
  return (scaled(axis.scale, value) - low) / (scaled(axis.scale, axis.high) - low);
}

std::vector<Tick> axis_ticks(const Axis& axis, int parts) {
  std::vector<Tick> ticks;
  const auto add = [&](double value, std::string text) {
    const double position = axis_position(axis, value);
    if (position >= -1e-9 && position <= 1 + 1e-9) ticks.push_back({position, with_minus_signs(std::move(text))});
  };
  if (!axis.ticks.empty()) {
    for (const double value : axis.ticks) add(value, to_text(value));
  } else if (axis.scale == Scale::digits) {
    for (const int count : {1, 2, 3, 5, 7, 10, 15, 20, 30, 50, 70, 100, 150, 200, 300}) {
      add(std::pow(10, -count), "10^{-" + std::to_string(count) + "}");
    }
  } else if (axis.scale == Scale::logarithmic) {
    const int first = static_cast<int>(std::ceil(std::log10(axis.low) - 1e-9));
    const int last = static_cast<int>(std::floor(std::log10(axis.high) + 1e-9));
    const int step = std::max(1, (last - first + parts - 1) / parts);
    for (int power = first; power <= last; power += step)
      add(std::pow(10, power), "10^{" + std::to_string(power) + "}");
  } else {
    const double unit = std::pow(10, unit_power(axis));
    for (const double number : round_numbers(axis.low / unit, axis.high / unit, parts)) {
      add(number * unit, to_text(number));
    }
  }
  return ticks;
}

std::string axis_label(const Axis& axis) {
  const int power = unit_power(axis);
  if (power == 0) return axis.label;
  const std::string unit = with_minus_signs("in 10^{" + std::to_string(power) + "}");
  return axis.label.empty() ? unit : axis.label + " (" + unit + ")";
}

Colour viridis(double share) {
  static constexpr std::array<std::array<double, 3>, 9> kAnchors{{{68, 1, 84},
                                                                  {72, 40, 120},
                                                                  {59, 82, 139},
                                                                  {44, 114, 142},
                                                                  {33, 145, 140},
                                                                  {40, 174, 128},
                                                                  {94, 201, 98},
                                                                  {173, 220, 48},
                                                                  {253, 231, 37}}};
  const double position = share > 0 ? std::min(share, 1.0) * 8 : 0.0;
  const auto low = static_cast<std::size_t>(std::min(position, 7.0));
  const double t = position - static_cast<double>(low);
  const auto at = [&](std::size_t c) { return ((1 - t) * kAnchors[low][c] + t * kAnchors[low + 1][c]) / 255; };
  return {at(0), at(1), at(2)};
}

Colour series_colour(std::size_t index) {
  static constexpr std::array<Colour, 7> kColours{{{0.000, 0.447, 0.698},
                                                   {0.835, 0.369, 0.000},
                                                   {0.000, 0.620, 0.451},
                                                   {0.800, 0.475, 0.655},
                                                   {0.902, 0.624, 0.000},
                                                   {0.337, 0.706, 0.914},
                                                   {0.498, 0.235, 0.553}}};
  return kColours[index % kColours.size()];
}

}  // namespace sklar::plot
