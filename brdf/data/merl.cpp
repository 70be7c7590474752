#include "brdf/data/merl.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "copula/error.hpp"
#include "copula/file.hpp"

namespace sklar::brdf {
namespace fs = std::filesystem;
namespace {

static_assert(std::endian::native == std::endian::little, "the reader copies little-endian numbers");

constexpr MerlDimensions kDimensions = {Grid::theta_h, Grid::theta_d, Grid::phi_d};
constexpr std::array<double, 3> kScale = {1.0 / 1500, 1.15 / 1500, 1.66 / 1500};
constexpr std::array<const char*, 3> kChannel = {"red", "green", "blue"};
constexpr double kLargest = 1e300;  // raw = value * 1500 stays finite

constexpr std::size_t cells_of(const MerlDimensions& dimensions) {
  std::size_t cells = 1;
  for (const std::int32_t extent : dimensions) cells *= static_cast<std::size_t>(extent);
  return cells;
}

constexpr std::size_t bytes_of(const MerlDimensions& dimensions) {
  return sizeof dimensions + 3 * cells_of(dimensions) * sizeof(double);
}
static_assert(bytes_of(kDimensions) == 34'992'012);

std::string to_text(const MerlDimensions& dimensions) {
  std::string text;
  for (const std::int32_t extent : dimensions) text += (text.empty() ? "" : " ") + std::to_string(extent);
  return text;
}

std::string place(std::size_t channel, std::size_t cell, const MerlDimensions& dimensions) {
  const auto theta_d = static_cast<std::size_t>(dimensions[1]), phi_d = static_cast<std::size_t>(dimensions[2]);
  const std::size_t row = cell / phi_d;
  return std::string(kChannel[channel]) + " value at (theta_h, theta_d, phi_d) = (" + std::to_string(row / theta_d) +
         ", " + std::to_string(row % theta_d) + ", " + std::to_string(cell % phi_d) + ")";
}

void require_size(const fs::path& path, std::uintmax_t found, std::size_t expected) {
  if (found == expected) return;
  throw FileError(path.string(), "has " + std::to_string(found) + " bytes, expected " + std::to_string(expected));
}

std::string read_checked(const fs::path& path, const MerlDimensions& dimensions) {
  const std::size_t expected = bytes_of(dimensions);
  // A regular file of another size is refused before any of it is read.
  if (std::error_code error; fs::is_regular_file(path, error)) require_size(path, fs::file_size(path), expected);
  std::string bytes = read_file(path);
  require_size(path, bytes.size(), expected);
  MerlDimensions found;
  std::memcpy(found.data(), bytes.data(), sizeof found);
  if (found != dimensions) {
    throw FileError(path.string(), "dimensions are " + to_text(found) + ", expected " + to_text(dimensions));
  }
  return bytes;
}

/// Raw values of one plane in, f_r out; clears `valid` where raw is negative. @return the first cell that is not
/// finite, where it stops; the number of cells if all are.
std::size_t scale_plane(double scale, std::vector<double>& plane, std::vector<std::uint8_t>& valid) {
  for (std::size_t cell = 0; cell < plane.size(); ++cell) {
    if (!std::isfinite(plane[cell])) return cell;
    if (plane[cell] < 0) valid[cell] = 0;
    plane[cell] *= scale;
  }
  return plane.size();
}

/// The raw value that reads back as `value`, where one exists: then it lies within two steps of the quotient.
double unscale(double value, double scale) {
  const double quotient = value / scale;
  if (quotient * scale == value) return quotient;
  constexpr double kUp = std::numeric_limits<double>::infinity();
  for (const double toward : {kUp, -kUp}) {
    double raw = quotient;
    for (int step = 0; step < 2; ++step) {
      raw = std::nextafter(raw, toward);
      if (raw * scale == value) return raw;
    }
  }
  return quotient;
}

}  // namespace

MerlCells read_merl_cells(const fs::path& path, const MerlDimensions& dimensions) {
  const std::string bytes = read_checked(path, dimensions);
  MerlCells cells;
  cells.valid.assign(cells_of(dimensions), 1);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    std::vector<double>& plane = cells.values[channel];
    plane.resize(cells.valid.size());
    const std::size_t plane_bytes = plane.size() * sizeof(double);
    std::memcpy(plane.data(), bytes.data() + sizeof dimensions + channel * plane_bytes, plane_bytes);
    const std::size_t bad = scale_plane(kScale[channel], plane, cells.valid);
    if (bad == plane.size()) continue;
    throw FileError(path.string(), place(channel, bad, dimensions) + " is " + sklar::to_text(plane[bad]));
  }
  if (std::count(cells.valid.begin(), cells.valid.end(), 1) == 0) {
    throw FileError(path.string(), "every cell is masked (negative), expected some values");
  }
  for (std::vector<double>& plane : cells.values) {
    for (std::size_t cell = 0; cell < plane.size(); ++cell) plane[cell] = cells.valid[cell] ? plane[cell] : 0.0;
  }
  return cells;
}

MeasuredTable read_merl(const fs::path& path, Provenance provenance) {
  MerlCells cells = read_merl_cells(path, kDimensions);
  MeasuredTable table{.name = path.stem().string(),
                      .provenance = provenance,
                      .report = {},
                      .values = std::move(cells.values),
                      .valid = std::move(cells.valid)};
  table.report.mirror_asymmetry = mirror_asymmetry(table);
  return table;
}

void write_merl(const fs::path& path, const MeasuredTable& table) {
  require_table("write_merl", table);
  std::string bytes(bytes_of(kDimensions), '\0');
  std::memcpy(bytes.data(), kDimensions.data(), sizeof kDimensions);
  std::vector<double> raw(Grid::cells);
  constexpr std::size_t kPlane = Grid::cells * sizeof(double);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    for (std::size_t cell = 0; cell < raw.size(); ++cell) {
      const double value = table.values[channel][cell];
      if (value > kLargest) {
        throw FileError(path.string(), place(channel, cell, kDimensions) + " is " + sklar::to_text(value) +
                                           ", the format ends at 1e300");
      }
      raw[cell] = table.valid[cell] ? unscale(value, kScale[channel]) : -1.0;
    }
    std::memcpy(bytes.data() + sizeof kDimensions + channel * kPlane, raw.data(), kPlane);
  }
  write_file(path, bytes);
}

}  // namespace sklar::brdf
