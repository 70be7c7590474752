#include "brdf/data/merl.hpp"

#include <cmath>
#include <cstring>
#include <limits>

#include "copula/error.hpp"
#include "copula/file.hpp"
#include "copula/random.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sklar::brdf {
namespace {
namespace fs = std::filesystem;

constexpr std::size_t kHeader = 12;
constexpr std::size_t kBytes = 34'992'012;

std::size_t offset(std::size_t channel, int cell) {
  return kHeader + sizeof(double) * (channel * Grid::cells + static_cast<std::size_t>(cell));
}

double raw(const std::string& bytes, std::size_t channel, int cell) {
  double value;
  std::memcpy(&value, bytes.data() + offset(channel, cell), sizeof value);
  return value;
}

void set_raw(std::string& bytes, std::size_t channel, int cell, double value) {
  std::memcpy(bytes.data() + offset(channel, cell), &value, sizeof value);
}

class Merl : public test::TemporaryFolder {
 protected:
  /// A file with a value of its own in every cell, some of them masked.
  static const std::string& sample() {
    static const std::string bytes = [] {
      std::string file(kBytes, '\0');
      const std::int32_t dimensions[] = {90, 90, 180};
      std::memcpy(file.data(), dimensions, sizeof dimensions);
      Rng rng(3);
      for (std::size_t channel = 0; channel < 3; ++channel) {
        for (int cell = 0; cell < Grid::cells; ++cell) {
          set_raw(file, channel, cell, cell % 4 == 3 ? -1.0 : std::exp(30 * uniform(rng) - 20));
        }
      }
      return file;
    }();
    return bytes;
  }

  void expect_bytes_refused(const std::string& bytes, const std::string& reason) {
    const fs::path path = folder_ / "bad.binary";
    write_file(path, bytes);
    expect_refused(path, reason);
  }

  static void expect_refused(const fs::path& path, const std::string& reason) {
    try {
      (void)read_merl(path);
      ADD_FAILURE() << "was read; expected: " << reason;
    } catch (const FileError& error) {
      EXPECT_EQ(error.what(), path.string() + ": " + reason);
    }
  }
};

TEST_F(Merl, ValuesAreScaledAndMasked) {
  const fs::path path = folder_ / "blue-paint.binary";
  std::string bytes = sample();
  set_raw(bytes, 1, Grid::index(2, 3, 4), -0.5);  // one channel is enough
  write_file(path, bytes);
  const MeasuredTable table = read_merl(path, Provenance::reconstruction);
  EXPECT_EQ(table.name, "blue-paint");
  EXPECT_EQ(table.provenance, Provenance::reconstruction);
  EXPECT_EQ(table.valid_cells(), std::size_t{3} * Grid::cells / 4 - 1);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    EXPECT_EQ(table.values[channel][static_cast<std::size_t>(Grid::index(2, 3, 4))], 0);
    EXPECT_EQ(table.values[channel][3], 0);
  }
  EXPECT_DOUBLE_EQ(table.values[0][5], raw(bytes, 0, 5) / 1500);
  EXPECT_DOUBLE_EQ(table.values[1][5], raw(bytes, 1, 5) * 1.15 / 1500);
  EXPECT_DOUBLE_EQ(table.values[2][5], raw(bytes, 2, 5) * 1.66 / 1500);
}

TEST_F(Merl, ReadingBackIsExactToTheBit) {
  write_file(folder_ / "a.binary", sample());
  const MeasuredTable first = read_merl(folder_ / "a.binary");
  write_merl(folder_ / "b.binary", first);
  const MeasuredTable second = read_merl(folder_ / "b.binary");
  EXPECT_EQ(first.valid, second.valid);
  for (std::size_t channel = 0; channel < 3; ++channel) EXPECT_TRUE(first.values[channel] == second.values[channel]);
}

TEST_F(Merl, AnyValueIsKeptToRounding) {
  write_file(folder_ / "a.binary", sample());
  MeasuredTable table = read_merl(folder_ / "a.binary");
  Rng rng(4);
  for (auto& plane : table.values) {
    for (std::size_t cell = 0; cell < plane.size(); ++cell) plane[cell] = table.valid[cell] * std::exp(uniform(rng));
  }
  write_merl(folder_ / "b.binary", table);
  const MeasuredTable back = read_merl(folder_ / "b.binary");
  double worst = 0;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    for (std::size_t cell = 0; cell < Grid::cells; ++cell) {
      if (!table.valid[cell]) continue;
      worst = std::max(worst, std::abs(back.values[channel][cell] / table.values[channel][cell] - 1));
    }
  }
  EXPECT_LE(worst, 3e-16);
}

TEST_F(Merl, BadFilesAreRefusedByName) {
  const std::string expected = ", expected 34992012";
  expect_bytes_refused("", "has 0 bytes" + expected);
  expect_bytes_refused(sample().substr(0, 7), "has 7 bytes" + expected);
  expect_bytes_refused(sample().substr(0, kBytes - 1), "has 34992011 bytes" + expected);
  expect_bytes_refused(sample() + "x", "has 34992013 bytes" + expected);
  expect_refused(folder_ / "missing.binary", "no such file");
  expect_refused(folder_, "is a directory, not a file");

  std::string bytes = sample();
  bytes[8] = 60;
  expect_bytes_refused(bytes, "dimensions are 90 90 60, expected 90 90 180");

  bytes = sample();
  set_raw(bytes, 1, Grid::index(1, 2, 3), std::numeric_limits<double>::quiet_NaN());
  expect_bytes_refused(bytes, "green value at (theta_h, theta_d, phi_d) = (1, 2, 3) is nan");
  set_raw(bytes, 1, Grid::index(1, 2, 3), std::numeric_limits<double>::infinity());
  expect_bytes_refused(bytes, "green value at (theta_h, theta_d, phi_d) = (1, 2, 3) is inf");

  bytes = sample();
  for (int cell = 0; cell < Grid::cells; ++cell) set_raw(bytes, 2, cell, -1);
  expect_bytes_refused(bytes, "every cell is masked (negative), expected some values");
}

TEST_F(Merl, BadTablesAreNotWritten) {
  write_file(folder_ / "a.binary", sample());
  const MeasuredTable good = read_merl(folder_ / "a.binary");
  EXPECT_THROW(write_merl(folder_ / "missing" / "b.binary", good), FileError);
  const auto refused = [&](MeasuredTable table) {
    EXPECT_THROW(write_merl(folder_ / "b.binary", table), std::invalid_argument);
    EXPECT_FALSE(fs::exists(folder_ / "b.binary"));
  };
  MeasuredTable bad = good;
  bad.values[2][0] = std::numeric_limits<double>::quiet_NaN();
  refused(bad);
  bad.values[2][0] = -1;
  refused(bad);
  bad.values[2].pop_back();
  refused(bad);
  bad = good;
  bad.valid.assign(Grid::cells, 0);
  refused(bad);
  bad = good;
  bad.values[0][0] = 2e300;
  EXPECT_THROW(write_merl(folder_ / "b.binary", bad), FileError);
  EXPECT_FALSE(fs::exists(folder_ / "b.binary"));
}

}  // namespace
}  // namespace sklar::brdf
