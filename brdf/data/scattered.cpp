#include "brdf/data/scattered.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "brdf/data/cell_directions.hpp"
#include "brdf/data/colour.hpp"
#include "brdf/geometry/coordinates.hpp"
#include "brdf/geometry/frame.hpp"
#include "copula/error.hpp"
#include "copula/file.hpp"
#include "copula/inference/csv.hpp"

namespace sklar::brdf {
namespace fs = std::filesystem;
namespace {

constexpr double kRightAngle = std::numbers::pi / 2;
constexpr double kReach = 0.1;
constexpr double kSame = 1e-9;  // a distance below is this one
constexpr std::size_t kNeighbours = 8;

[[noreturn]] void fail(const fs::path& path, std::size_t line, const std::string& what) {
  throw FileError(path.string(), "line " + std::to_string(line) + ": " + what);
}

/// Numbers of a text in order, each with the line that it stands in.
class Numbers {
 public:
  explicit Numbers(fs::path path) : path_(std::move(path)), text_(read_file(path_)) { skip(); }

  [[nodiscard]] bool end() const { return place_ == text_.size(); }

  /// @throws FileError at the end of the text too, saying what was expected.
  double next(const std::string& what) {
    if (end()) fail(what + " is missing at the end of the file");
    last_ = line_;
    double value = 0;
    const char* const from = text_.data() + place_;
    const auto [stop, error] = std::from_chars(from, text_.data() + text_.size(), value);
    const std::size_t length = std::min(text_.find_first_of(" \t\r\n#", place_), text_.size()) - place_;
    if (error != std::errc() || stop != from + length || !std::isfinite(value)) {
      fail(what + " must be a number, got '" + text_.substr(place_, std::min<std::size_t>(length, 20)) + "'");
    }
    place_ += length;
    skip();
    return value;
  }

  /// About the number read last.
  [[noreturn]] void fail(const std::string& what) const { brdf::fail(path_, last_, what); }

 private:
  /// To the next number, past blanks and comments.
  void skip() {
    for (; !end(); ++place_) {
      if (text_[place_] == '#') place_ = std::min(text_.find('\n', place_), text_.size());
      if (end() || std::string_view(" \t\r\n").find(text_[place_]) == std::string_view::npos) return;
      if (text_[place_] == '\n') ++line_;
    }
  }

  fs::path path_;
  std::string text_;
  std::size_t place_ = 0, line_ = 1, last_ = 1;
};

std::vector<double> read_wavelengths(Numbers& numbers) {
  constexpr double kMost = 10000;
  const double count = numbers.next("the number of wavelengths");
  if (!(count >= 2 && count <= kMost) || count != std::floor(count)) {
    numbers.fail("the number of wavelengths must be 2 to 10000, got " + sklar::to_text(count));
  }
  std::vector<double> wavelengths;
  while (wavelengths.size() < static_cast<std::size_t>(count)) {
    const double wavelength = numbers.next("a wavelength");
    if (!wavelengths.empty() && !(wavelength > wavelengths.back())) numbers.fail("wavelengths must ascend");
    wavelengths.push_back(wavelength);
  }
  return wavelengths;
}

Vec3 read_direction(Numbers& numbers, const char* theta, const char* phi) {
  const double polar = numbers.next(theta);
  if (!(polar >= 0 && polar < kRightAngle)) {
    numbers.fail(std::string(theta) + " must be in [0, pi/2), got " + sklar::to_text(polar));
  }
  return spherical_direction(polar, numbers.next(phi));
}

/// Where a pair lies, so that pairs of like reflectance lie close.
Vec3 point_of(const HalfDifference& at) {
  const double r = std::sqrt(at.theta_h / kRightAngle);
  return {r * std::cos(2 * at.phi_d), r * std::abs(std::sin(2 * at.phi_d)), at.theta_d / kRightAngle};
}

struct Neighbour {
  double distance;
  std::size_t sample;
};

/// The samples as a k-d tree: the middle of a range of `order_` divides it along one axis, the next axis its halves.
class Neighbourhood {
 public:
  explicit Neighbourhood(std::span<const ScatteredSample> samples) : order_(samples.size()) {
    for (const ScatteredSample& sample : samples) points_.push_back(point_of(half_difference(sample.wo, sample.wi)));
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    divide(0, order_.size(), 0);
  }

  using Found = std::array<Neighbour, kNeighbours + 1>;

  /// The nearest ones, nearest first.
  [[nodiscard]] Found nearest(const Vec3& point) const {
    Found found;
    found.fill({std::numeric_limits<double>::infinity(), 0});
    visit(point, 0, order_.size(), 0, found);
    return found;
  }

 private:
  void divide(std::size_t first, std::size_t last, int axis) {
    if (last - first < 2) return;
    const std::size_t middle = (first + last) / 2;
    const auto at = [&](std::size_t n) { return order_.begin() + static_cast<std::ptrdiff_t>(n); };
    std::nth_element(at(first), at(middle), at(last),
                     [&](std::size_t a, std::size_t b) { return points_[a][axis] < points_[b][axis]; });
    divide(first, middle, (axis + 1) % 3);
    divide(middle + 1, last, (axis + 1) % 3);
  }

  void visit(const Vec3& point, std::size_t first, std::size_t last, int axis, Found& found) const {
    if (first == last) return;
    const std::size_t middle = (first + last) / 2;
    const Vec3& here = points_[order_[middle]];
    Neighbour next{(point - here).norm(), order_[middle]};
    for (Neighbour& each : found) {
      if (next.distance < each.distance) std::swap(next, each);
    }
    const double ahead = point[axis] - here[axis];
    const auto half = [&](bool low) {
      visit(point, low ? first : middle + 1, low ? middle : last, (axis + 1) % 3, found);
    };
    half(ahead < 0);
    if (std::abs(ahead) < found.back().distance) half(ahead >= 0);
  }

  std::vector<Vec3> points_;
  std::vector<std::size_t> order_;
};

/// What the samples say of a point; false where none is near.
bool interpolate(const Neighbourhood& neighbourhood, std::span<const ScatteredSample> samples, const Vec3& point,
                 Rgb& value) {
  const Neighbourhood::Found found = neighbourhood.nearest(point);
  if (found.front().distance > kReach) return false;
  const auto value_of = [&](const Neighbour& each) -> Rgb { return samples[each.sample].value.max(0.0); };
  const double radius = std::max(found.back().distance, kSame);
  Rgb sum = Rgb::Zero();
  double weight = 0;
  for (const Neighbour& each : found) {
    const double share = std::pow((radius - each.distance) / (radius * std::max(each.distance, kSame)), 2);
    sum += share * value_of(each);
    weight += share;
  }
  value = weight > 0 ? Rgb(sum / weight) : value_of(found.front());  // 0 where all are equally far
  return true;
}

}  // namespace

std::vector<ScatteredSample> read_scattered_csv(const fs::path& path) {
  constexpr double kLengthTolerance = 1e-6;
  const Table table = read_csv(path);
  if (table.names != std::vector<std::string>{"wi_x", "wi_y", "wi_z", "wo_x", "wo_y", "wo_z", "r", "g", "b"}) {
    fail(path, 1, "the header must be wi_x,wi_y,wi_z,wo_x,wo_y,wo_z,r,g,b");
  }
  std::vector<ScatteredSample> samples;
  for (Eigen::Index row = 0; row < table.values.rows(); ++row) {
    const auto line = static_cast<std::size_t>(row) + 2;
    const auto direction = [&](Eigen::Index first, const char* name) {
      const Vec3 w = table.values.row(row).segment<3>(first).transpose();
      const double length = w.norm();
      if (!(std::abs(length - 1) <= kLengthTolerance)) {
        fail(path, line, std::string(name) + " must have length 1, got " + sklar::to_text(length));
      }
      if (!(w.z() > 0)) fail(path, line, std::string(name) + "_z must be positive, got " + sklar::to_text(w.z()));
      return Vec3(w / length);
    };
    const Vec3 wi = direction(0, "wi");
    const Vec3 wo = direction(3, "wo");
    const Rgb value = table.values.row(row).tail<3>().transpose();
    if (!value.isFinite().all()) fail(path, line, "r, g and b must be finite");
    samples.push_back({wo, wi, value});
  }
  return samples;
}

std::vector<ScatteredSample> read_pbrt_brdf(const fs::path& path) {
  Numbers numbers(path);
  const std::vector<Rgb> weights = rgb_weights(read_wavelengths(numbers));
  std::vector<ScatteredSample> samples;
  while (!numbers.end()) {
    const Vec3 wi = read_direction(numbers, "theta_i", "phi_i");
    const Vec3 wo = read_direction(numbers, "theta_o", "phi_o");
    Rgb value = Rgb::Zero();
    for (const Rgb& weight : weights) value += weight * numbers.next("f_r");
    samples.push_back({wo, wi, value});
  }
  return samples;
}

MeasuredTable tabulate_scattered(std::span<const ScatteredSample> samples, std::string name, Provenance provenance) {
  if (samples.size() <= kNeighbours) {
    throw std::invalid_argument("tabulate_scattered: '" + name + "' has " + std::to_string(samples.size()) +
                                " samples, at least " + std::to_string(kNeighbours + 1) + " are needed");
  }
  const Neighbourhood neighbourhood(samples);
  MeasuredTable table{.name = std::move(name), .provenance = provenance, .report = {}, .values = {}, .valid = {}};
  table.valid.assign(Grid::cells, 0);
  for (std::vector<double>& plane : table.values) plane.assign(Grid::cells, 0.0);
  tbb::parallel_for(0, Grid::theta_h * Grid::theta_d, [&](int row) {
    const int i = row / Grid::theta_d, j = row % Grid::theta_d;
    for (int k = 0; k < Grid::phi_d / 2; ++k) {
      const HalfDifference centre{Grid::theta_h_centre(i), Grid::theta_d_centre(j), Grid::phi_d_centre(k)};
      const DirectionPair pair = cell_directions(i, j, k);
      Rgb value;
      if (!(pair.wi.z() > 0 && pair.wo.z() > 0)) continue;
      if (!interpolate(neighbourhood, samples, point_of(centre), value)) continue;
      for (const int mirrored : {k, Grid::phi_d - 1 - k}) {
        const auto cell = static_cast<std::size_t>(row * Grid::phi_d + mirrored);
        for (std::size_t c = 0; c < 3; ++c) table.values[c][cell] = value[static_cast<int>(c)];
        table.valid[cell] = 1;
      }
    }
  });
  if (table.valid_cells() == 0) {
    throw std::invalid_argument("tabulate_scattered: no cell of '" + table.name + "' is near a sample");
  }
  const auto negative = [](const ScatteredSample& sample) { return (sample.value < 0).count(); };
  double below = 0;
  for (const ScatteredSample& sample : samples) below += static_cast<double>(negative(sample));
  table.report.negative_share = below / (3 * static_cast<double>(samples.size()));
  return table;
}

}  // namespace sklar::brdf
