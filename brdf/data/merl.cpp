#include "brdf/data/merl.hpp"

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

using Dimensions = std::array<std::int32_t, 3>;
constexpr Dimensions kDimensions = {Grid::theta_h, Grid::theta_d, Grid::phi_d};
constexpr std::array<double, 3> kScale = {1.0 / 1500, 1.15 / 1500, 1.66 / 1500};
constexpr std::array<const char*, 3> kChannel = {"red", "green", "blue"};
constexpr std::size_t kPlane = Grid::cells * sizeof(double);
constexpr std::size_t kBytes = sizeof(Dimensions) + 3 * kPlane;
static_assert(kBytes == 34'992'012);
constexpr double kLargest = 1e300;  // raw = value * 1500 stays finite

std::string place(std::size_t channel, std::size_t cell) {
  const std::size_t row = cell / Grid::phi_d;
  return std::string(kChannel[channel]) + " value at (theta_h, theta_d, phi_d) = (" +
         std::to_string(row / Grid::theta_d) + ", " + std::to_string(row % Grid::theta_d) + ", " +
         std::to_string(cell % Grid::phi_d) + ")";
}

void require_size(const fs::path& path, std::uintmax_t found) {
  if (found == kBytes) return;
  throw FileError(path.string(), "has " + std::to_string(found) + " bytes, expected " + std::to_string(kBytes));
}

std::string read_checked(const fs::path& path) {
  // A regular file of another size is refused before any of it is read.
  if (std::error_code error; fs::is_regular_file(path, error)) require_size(path, fs::file_size(path));
  std::string bytes = read_file(path);
  require_size(path, bytes.size());
  Dimensions found;
  std::memcpy(found.data(), bytes.data(), sizeof found);
  if (found != kDimensions) {
    throw FileError(path.string(), "dimensions are " + std::to_string(found[0]) + " " + std::to_string(found[1]) + " " +
                                       std::to_string(found[2]) + ", expected 90 90 180");
  }
  return bytes;
}

/// Raw values of one plane in, f_r out; clears `valid` where raw is negative.
void scale_plane(const fs::path& path, std::size_t channel, std::vector<double>& plane,
                 std::vector<std::uint8_t>& valid) {
  for (std::size_t cell = 0; cell < plane.size(); ++cell) {
    const double raw = plane[cell];
    if (!std::isfinite(raw)) throw FileError(path.string(), place(channel, cell) + " is " + sklar::to_text(raw));
    if (raw < 0) valid[cell] = 0;
    plane[cell] = raw * kScale[channel];
  }
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

MeasuredTable read_merl(const fs::path& path, Provenance provenance) {
  const std::string bytes = read_checked(path);
  MeasuredTable table;
  table.name = path.stem().string();
  table.provenance = provenance;
  table.valid.assign(Grid::cells, 1);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    std::vector<double>& plane = table.values[channel];
    plane.resize(Grid::cells);
    std::memcpy(plane.data(), bytes.data() + sizeof(Dimensions) + channel * kPlane, kPlane);
    scale_plane(path, channel, plane, table.valid);
  }
  if (table.valid_cells() == 0) throw FileError(path.string(), "every cell is masked (negative), expected some values");
  for (std::vector<double>& plane : table.values) {
    for (std::size_t cell = 0; cell < plane.size(); ++cell) plane[cell] = table.valid[cell] ? plane[cell] : 0.0;
  }
  table.report.mirror_asymmetry = mirror_asymmetry(table);
  return table;
}

void write_merl(const fs::path& path, const MeasuredTable& table) {
  require_table("write_merl", table);
  std::string bytes(kBytes, '\0');
  std::memcpy(bytes.data(), kDimensions.data(), sizeof kDimensions);
  std::vector<double> raw(Grid::cells);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    for (std::size_t cell = 0; cell < raw.size(); ++cell) {
      const double value = table.values[channel][cell];
      if (value > kLargest) {
        throw FileError(path.string(),
                        place(channel, cell) + " is " + sklar::to_text(value) + ", the format ends at 1e300");
      }
      raw[cell] = table.valid[cell] ? unscale(value, kScale[channel]) : -1.0;
    }
    std::memcpy(bytes.data() + sizeof(Dimensions) + channel * kPlane, raw.data(), kPlane);
  }
  write_file(path, bytes);
}

}  // namespace sklar::brdf
