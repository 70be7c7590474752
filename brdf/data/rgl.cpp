#include "brdf/data/rgl.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "brdf/geometry/frame.hpp"

namespace sklar::brdf {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kFloatRounding = 1e-6;  // pi/2 in single precision lies above pi/2

std::string text(const std::vector<std::size_t>& shape) {
  std::string result;
  for (const std::size_t extent : shape) result += (result.empty() ? "" : " x ") + std::to_string(extent);
  return result;
}

void require_shape(const TensorFile& file, const std::string& name, const FloatTensor& tensor,
                   const std::vector<std::size_t>& expected) {
  if (tensor.shape == expected) return;
  file.fail("field '" + name + "' has shape " + text(tensor.shape) + ", expected " + text(expected));
}

void require_at_least(const TensorFile& file, const std::string& name, const FloatTensor& tensor, float lowest,
                      const char* expected) {
  const float found = *std::min_element(tensor.values.begin(), tensor.values.end());
  if (found < lowest) file.fail("field '" + name + "' holds " + std::to_string(found) + ", expected " + expected);
}

/// `ndf` or `sigma`: two equal rows over phi, columns over theta.
BilinearStack read_profile(const TensorFile& file, const std::string& name, float lowest, const char* expected) {
  const FloatTensor tensor = file.floats(name, 2);
  if (tensor.shape[0] != 2 || tensor.shape[1] < 2) {
    file.fail("field '" + name + "' has shape " + text(tensor.shape) + ", expected 2 x (2 or more)");
  }
  require_at_least(file, name, tensor, lowest, expected);
  return {1, 2, static_cast<int>(tensor.shape[1]), tensor.values};
}

/// Slices at the first phi_i of a field of shape (P, T, extra..., rows, columns).
struct Slices {
  int images, rows, columns;
  FloatTensor tensor;
  [[nodiscard]] std::span<const float> first() const {
    return std::span(tensor.values).first(static_cast<std::size_t>(images) * rows * columns);
  }
};

Slices read_slices(const TensorFile& file, const std::string& name, std::vector<std::size_t> leading) {
  FloatTensor tensor = file.floats(name, leading.size() + 2);
  const std::size_t rows = tensor.shape[leading.size()];
  const std::size_t columns = tensor.shape[leading.size() + 1];
  std::size_t images = 1;
  for (std::size_t n = 1; n < leading.size(); ++n) images *= leading[n];
  leading.insert(leading.end(), {std::max<std::size_t>(rows, 2), std::max<std::size_t>(columns, 2)});
  require_shape(file, name, tensor, leading);
  return {static_cast<int>(images), static_cast<int>(rows), static_cast<int>(columns), std::move(tensor)};
}

/// Ascending angles in [0,pi/2]; refuses anisotropic files first, since their shapes differ.
std::vector<double> read_theta_i(const TensorFile& file) {
  const std::size_t azimuths = file.floats("phi_i", 1).shape[0];
  if (azimuths > 2) {
    file.fail("is anisotropic (" + std::to_string(azimuths) + " values of phi_i); only isotropic files are read");
  }
  if (!file.has("rgb") && file.has("wavelengths")) {
    file.fail("holds spectra and no field 'rgb'; only RGB files are read");
  }
  const FloatTensor tensor = file.floats("theta_i", 1);
  std::vector<double> theta_i(tensor.values.begin(), tensor.values.end());
  const bool ascending = std::adjacent_find(theta_i.begin(), theta_i.end(), std::greater_equal<>()) == theta_i.end();
  if (!ascending || theta_i.front() < 0 || theta_i.back() > kPi / 2 + kFloatRounding) {
    file.fail("field 'theta_i' must ascend within [0, pi/2]");
  }
  return theta_i;
}

BilinearStack read_rgb(const TensorFile& file, std::size_t azimuths, std::size_t slices) {
  const Slices rgb = read_slices(file, "rgb", {azimuths, slices, 3});
  return {rgb.images, rgb.rows, rgb.columns, rgb.first()};
}

BilinearWarp read_warp(const TensorFile& file, std::size_t azimuths, std::size_t slices) {
  const Slices vndf = read_slices(file, "vndf", {azimuths, slices});
  require_at_least(file, "vndf", vndf.tensor, 0, "0 or more");
  try {
    return {vndf.images, vndf.rows, vndf.columns, vndf.first()};
  } catch (const std::invalid_argument&) {
    file.fail("field 'vndf' has a slice without mass");
  }
}

double share_below_zero(const std::vector<float>& values) {
  const auto below = std::count_if(values.begin(), values.end(), [](float value) { return value < 0; });
  return static_cast<double>(below) / static_cast<double>(values.size());
}

double theta_to_unit(double theta) {
  return std::sqrt(2 * theta / kPi);
}

Between between_angles(const std::vector<double>& nodes, double angle) {
  const auto above = std::upper_bound(nodes.begin(), nodes.end(), angle) - nodes.begin();
  const auto last = static_cast<std::ptrdiff_t>(nodes.size()) - 1;
  const auto low = std::clamp<std::ptrdiff_t>(above - 1, 0, last);
  const auto high = std::min(above, last);
  if (low == high) return {static_cast<int>(low), static_cast<int>(low), 0.0};
  const double from = nodes[static_cast<std::size_t>(low)];
  const double share = (angle - from) / (nodes[static_cast<std::size_t>(high)] - from);
  return {static_cast<int>(low), static_cast<int>(high), share};
}

}  // namespace

RglMaterial::RglMaterial(const std::filesystem::path& path) : RglMaterial(TensorFile(path)) {}

RglMaterial::RglMaterial(const TensorFile& file)
    : theta_i_(read_theta_i(file)),
      jacobian_(file.byte("jacobian") != 0),
      negative_share_(share_below_zero(file.floats("rgb", 5).values)),
      ndf_(read_profile(file, "ndf", 0.0F, "0 or more")),
      sigma_(read_profile(file, "sigma", std::numeric_limits<float>::min(), "more than 0")),
      rgb_(read_rgb(file, file.floats("phi_i", 1).shape[0], theta_i_.size())),
      vndf_(read_warp(file, file.floats("phi_i", 1).shape[0], theta_i_.size())) {}

Rgb RglMaterial::f_cos(const Vec3& wo, const Vec3& wi) const {
  const Vec3 half = wi + wo;
  const double theta_i = polar_angle(wi);
  const double phi = std::atan2(half.y(), half.x()) - std::atan2(wi.y(), wi.x());
  const double turns = phi / (2 * kPi) + 0.5;
  const Vec2 u_half(theta_to_unit(polar_angle(half)), turns - std::floor(turns));

  const Between slice = between_angles(theta_i_, theta_i);
  const Vec2 s = vndf_.invert(u_half, slice);
  Rgb value;
  for (int channel = 0; channel < 3; ++channel) {
    value[channel] = rgb_.at(s, {3 * slice.low + channel, 3 * slice.high + channel, slice.share});
  }
  if (!jacobian_) return value;
  constexpr Between kOnly{0, 0, 0};
  return value * (ndf_.at(u_half, kOnly) / (4 * sigma_.at({theta_to_unit(theta_i), 0.5}, kOnly)));
}

}  // namespace sklar::brdf
