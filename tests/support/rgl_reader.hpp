#pragma once
/// A reader of `.bsdf` files that shares no code with the library's: what a renderer makes of a file.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace sklar::test {

using Direction = std::array<double, 3>;

/// The fields of a file, and what a material file must be.
class RglFile {
 public:
  struct Field {
    int type;
    std::vector<std::size_t> shape;
    std::string bytes;

    [[nodiscard]] float at(std::size_t n) const {
      float value;
      std::memcpy(&value, bytes.data() + 4 * n, 4);
      return value;
    }
  };

  /// @throws std::runtime_error naming what a renderer would refuse.
  explicit RglFile(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    const std::string all((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
    require(all.size() > 18 && all.compare(0, 14, std::string("tensor_file\0\1\0", 14)) == 0, "header");
    std::size_t place = 14;
    const auto number = [&](std::size_t size) {
      std::uint64_t value = 0;
      for (std::size_t k = 0; k < size; ++k) {
        value |= static_cast<std::uint64_t>(static_cast<unsigned char>(all.at(place + k))) << (8 * k);
      }
      place += size;
      return static_cast<std::size_t>(value);
    };
    for (std::size_t left = number(4); left > 0; --left) {
      const std::size_t length = number(2);
      const std::string name = all.substr(place, length);
      place += length;
      const std::size_t dimensions = number(2);
      Field field{static_cast<int>(number(1)), {}, {}};
      const std::size_t offset = number(8);
      require(offset % 8 == 0, name + " alignment");
      std::size_t size = field.type == 10 ? 4 : 1;
      for (std::size_t k = 0; k < dimensions; ++k) size *= field.shape.emplace_back(number(8));
      require(offset + size <= all.size(), name + " size");
      field.bytes = all.substr(offset, size);
      require(fields_.emplace(name, field).second, name + " twice");
    }
    check();
  }

  [[nodiscard]] const Field& field(const std::string& name) const { return fields_.at(name); }
  [[nodiscard]] bool spectral() const { return fields_.count("wavelengths") > 0; }
  [[nodiscard]] const Field& values() const { return field(spectral() ? "spectra" : "rgb"); }
  [[nodiscard]] bool isotropic() const { return field("phi_i").shape[0] <= 2; }
  [[nodiscard]] std::size_t channels() const { return values().shape[2]; }

 private:
  static void require(bool holds, const std::string& what) {
    if (!holds) throw std::runtime_error("not a material file: " + what);
  }

  /// The conditions of pbrt-v4 and Mitsuba 3.
  void check() const {
    for (const char* name : {"description", "jacobian"}) {
      require(fields_.count(name) > 0 && field(name).type == 1 && field(name).shape.size() == 1, name);
    }
    require(field("jacobian").shape[0] == 1, "jacobian");
    for (const auto& [name, dimensions] : std::map<std::string, std::size_t>{
             {"theta_i", 1}, {"phi_i", 1}, {"ndf", 2}, {"sigma", 2}, {"vndf", 4}, {"luminance", 4}}) {
      require(fields_.count(name) > 0 && field(name).type == 10 && field(name).shape.size() == dimensions, name);
    }
    const std::size_t P = field("phi_i").shape[0], T = field("theta_i").shape[0];
    require(spectral() == (fields_.count("spectra") > 0) && spectral() != (fields_.count("rgb") > 0),
            "one of two forms");
    require(values().type == 10 && values().shape.size() == 5, "values");
    require(!spectral() || field("wavelengths").shape == std::vector<std::size_t>{channels()}, "wavelengths");
    require(spectral() || channels() == 3, "rgb");
    for (const Field* each : {&field("vndf"), &field("luminance"), &values()}) {
      require(each->shape[0] == P && each->shape[1] == T, "slices");
    }
    const auto& shape = values().shape;
    require(shape[3] == shape[4] && field("luminance").shape[2] == shape[3] && field("luminance").shape[3] == shape[3],
            "square values");
    if (isotropic()) return;
    const double span = static_cast<double>(field("phi_i").at(P - 1)) - static_cast<double>(field("phi_i").at(0));
    require(std::lround(2 * std::numbers::pi / span) == 1, "the whole turn");
  }

  std::map<std::string, Field> fields_;
};

/// What a file says of one direction that is known to it.
class RglSlice {
 public:
  /// @param known unit, above the horizon.
  RglSlice(const RglFile& file, const Direction& known)
      : file_(file), known_(known), theta_(angle(known)), phi_(std::atan2(known[1], known[0])) {
    const auto [t, t_share] = between(file.field("theta_i"), theta_);
    const auto [p, p_share] =
        file.isotropic() ? std::pair<std::size_t, double>{0, 0.0} : between(file.field("phi_i"), phi_);
    const std::size_t T = file.field("theta_i").shape[0];
    for (const std::size_t dp : {0, 1}) {
      for (const std::size_t dt : {0, 1}) {
        const double weight = (dp == 1 ? p_share : 1 - p_share) * (dt == 1 ? t_share : 1 - t_share);
        if (weight > 0) corners_.push_back({(p + dp) * T + t + dt, weight});
      }
    }
    vndf_ = blend(file.field("vndf"), true);
    luminance_ = blend(file.field("luminance"), true);
    for (std::size_t c = 0; c < file.channels(); ++c)
      values_.push_back(blend(file.values(), false, c, file.channels()));
    integrate();
  }

  /// f_r cos(theta) of the other direction, a value for each channel.
  [[nodiscard]] std::vector<double> f_cos(const Direction& other) const {
    std::vector<double> result(values_.size(), 0.0);
    if (other[2] <= 0) return result;
    const Point u = half_of(other).u;
    const Point s = inverse(u);
    const bool jacobian = file_.field("jacobian").bytes[0] != 0;
    const double scale = jacobian ? profile("ndf").at(u) / (4 * profile("sigma").at(unit(theta_, phi_))) : 1.0;
    for (std::size_t c = 0; c < values_.size(); ++c) result[c] = values_[c].at(s) * scale;
    return result;
  }

  /// Density of the other direction per solid angle, as the readers draw it.
  [[nodiscard]] double pdf(const Direction& other) const {
    if (other[2] <= 0) return 0;
    const Half half = half_of(other);
    const double measure = std::max(2 * kPi * kPi * half.u.x * std::sin(half.theta), 1e-6) * 4 * half.cosine;
    return luminance_.at(inverse(half.u)) * vndf_.at(half.u) / measure;
  }

 private:
  static constexpr double kPi = std::numbers::pi;

  struct Point {
    double x, y;
  };
  struct Half {
    Point u;
    double theta, cosine;
  };
  struct Corner {
    std::size_t slice;
    double weight;
  };

  struct Image {
    std::size_t rows, columns;
    std::vector<double> values;

    [[nodiscard]] double at(const Point& u) const {
      const double x = std::clamp(u.x, 0.0, 1.0) * static_cast<double>(columns - 1);
      const double y = std::clamp(u.y, 0.0, 1.0) * static_cast<double>(rows - 1);
      const std::size_t i = std::min(static_cast<std::size_t>(x), columns - 2);
      const std::size_t j = std::min(static_cast<std::size_t>(y), rows - 2);
      const double a = x - static_cast<double>(i), b = y - static_cast<double>(j);
      const double* v = values.data() + j * columns + i;
      return (1 - b) * ((1 - a) * v[0] + a * v[1]) + b * ((1 - a) * v[columns] + a * v[columns + 1]);
    }

    /// Of the bilinear image over the unit square.
    [[nodiscard]] double integral() const {
      double sum = 0;
      for (std::size_t j = 0; j < rows; ++j) {
        for (std::size_t i = 0; i < columns; ++i) {
          const double share = (j == 0 || j == rows - 1 ? 0.5 : 1.0) * (i == 0 || i == columns - 1 ? 0.5 : 1.0);
          sum += share * values[j * columns + i];
        }
      }
      return sum / static_cast<double>((rows - 1) * (columns - 1));
    }
  };

  static double angle(const Direction& w) { return std::atan2(std::hypot(w[0], w[1]), w[2]); }
  static Point unit(double theta, double phi) {
    const double turns = phi / (2 * kPi) + 0.5;
    return {std::sqrt(2 * theta / kPi), turns - std::floor(turns)};
  }

  static std::pair<std::size_t, double> between(const RglFile::Field& nodes, double value) {
    std::size_t low = 0;
    while (low + 2 < nodes.shape[0] && static_cast<double>(nodes.at(low + 1)) <= value) ++low;
    const auto from = static_cast<double>(nodes.at(low)), to = static_cast<double>(nodes.at(low + 1));
    return {low, std::clamp((value - from) / (to - from), 0.0, 1.0)};
  }

  /// The image of a field between the slices, each divided by its integral if asked for.
  [[nodiscard]] Image blend(const RglFile::Field& field, bool normalise, std::size_t channel = 0,
                            std::size_t channels = 1) const {
    const std::size_t rows = field.shape[field.shape.size() - 2], columns = field.shape.back();
    Image sum{rows, columns, std::vector<double>(rows * columns, 0.0)};
    for (const Corner& corner : corners_) {
      Image one{rows, columns, {}};
      const std::size_t first = (corner.slice * channels + channel) * rows * columns;
      for (std::size_t n = 0; n < rows * columns; ++n) one.values.push_back(static_cast<double>(field.at(first + n)));
      const double scale = corner.weight / (normalise ? one.integral() : 1.0);
      for (std::size_t n = 0; n < rows * columns; ++n) sum.values[n] += scale * one.values[n];
    }
    return sum;
  }

  [[nodiscard]] const Image& profile(const std::string& name) const {
    Image& image = profiles_[name];
    if (image.values.empty()) {
      const RglFile::Field& field = file_.field(name);
      image = {field.shape[0], field.shape[1], {}};
      for (std::size_t n = 0; n < field.shape[0] * field.shape[1]; ++n)
        image.values.push_back(static_cast<double>(field.at(n)));
    }
    return image;
  }

  [[nodiscard]] Half half_of(const Direction& other) const {
    Direction m{known_[0] + other[0], known_[1] + other[1], known_[2] + other[2]};
    const double length = std::hypot(m[0], m[1], m[2]);
    const double theta = angle(m);
    const double phi = std::atan2(m[1], m[0]) - (file_.isotropic() ? phi_ : 0.0);
    const double cosine = (known_[0] * m[0] + known_[1] * m[1] + known_[2] * m[2]) / length;
    return {unit(theta, phi), theta, cosine};
  }

  /// Integrals of the density along each row, and of the rows, up to each node, by trapezoids.
  void integrate() {
    const std::size_t rows = vndf_.rows, columns = vndf_.columns;
    along_ = {rows, columns, std::vector<double>(rows * columns, 0.0)};
    over_.assign(rows, 0.0);
    for (std::size_t j = 0; j < rows; ++j) {
      for (std::size_t i = 1; i < columns; ++i) {
        const std::size_t n = j * columns + i;
        along_.values[n] =
            along_.values[n - 1] + (vndf_.values[n - 1] + vndf_.values[n]) / 2 / static_cast<double>(columns - 1);
      }
      if (j > 0) over_[j] = over_[j - 1] + (row(j - 1) + row(j)) / 2 / static_cast<double>(rows - 1);
    }
  }
  [[nodiscard]] double row(std::size_t j) const { return along_.values[(j + 1) * along_.columns - 1]; }

  /// The uniforms that the warp takes to u.
  [[nodiscard]] Point inverse(const Point& u) const {
    const double height = 1.0 / static_cast<double>(vndf_.rows - 1),
                 width = 1.0 / static_cast<double>(vndf_.columns - 1);
    const std::size_t j = std::min(static_cast<std::size_t>(u.y / height), vndf_.rows - 2);
    const std::size_t i = std::min(static_cast<std::size_t>(u.x / width), vndf_.columns - 2);
    const double b = u.y / height - static_cast<double>(j), a = u.x / width - static_cast<double>(i);
    const double below = over_[j] + height * (b * row(j) + b * b / 2 * (row(j + 1) - row(j)));
    const auto part = [&](std::size_t r) {
      const double* v = vndf_.values.data() + r * vndf_.columns + i;
      return along_.values[r * vndf_.columns + i] + width * (a * v[0] + a * a / 2 * (v[1] - v[0]));
    };
    const double whole = (1 - b) * row(j) + b * row(j + 1);
    return {((1 - b) * part(j) + b * part(j + 1)) / whole, below};
  }

  const RglFile& file_;
  Direction known_;
  double theta_, phi_;
  std::vector<Corner> corners_;
  Image vndf_, luminance_, along_;
  std::vector<double> over_;
  std::vector<Image> values_;
  mutable std::map<std::string, Image> profiles_;
};

}  // namespace sklar::test
