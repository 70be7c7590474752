#include "brdf/data/rgl.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "brdf/data/colour.hpp"
#include "brdf/geometry/frame.hpp"
#include "copula/error.hpp"

namespace sklar::brdf {

/// Slices of a field of shape (P, T, extra..., rows, columns): those of every phi_i, or the first one's if isotropic.
struct RglSlices {
  int images, rows, columns;
  FloatTensor tensor;
  [[nodiscard]] std::span<const float> values() const {
    return std::span(tensor.values).first(static_cast<std::size_t>(images) * rows * columns);
  }
};

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

/// `ndf` or `sigma`: rows over phi, two equal ones if isotropic; columns over theta.
BilinearStack read_profile(const TensorFile& file, const std::string& name, bool isotropic, float lowest,
                           const char* expected) {
  const FloatTensor tensor = file.floats(name, 2);
  if ((isotropic ? tensor.shape[0] != 2 : tensor.shape[0] < 2) || tensor.shape[1] < 2) {
    file.fail("field '" + name + "' has shape " + text(tensor.shape) + ", expected " +
              (isotropic ? "2" : "(2 or more)") + " x (2 or more)");
  }
  require_at_least(file, name, tensor, lowest, expected);
  return {1, static_cast<int>(tensor.shape[0]), static_cast<int>(tensor.shape[1]), tensor.values};
}

RglSlices read_slices(const TensorFile& file, const std::string& name, bool isotropic,
                      std::vector<std::size_t> leading) {
  FloatTensor tensor = file.floats(name, leading.size() + 2);
  const std::size_t rows = tensor.shape[leading.size()];
  const std::size_t columns = tensor.shape[leading.size() + 1];
  std::size_t images = isotropic ? 1 : leading[0];
  for (std::size_t n = 1; n < leading.size(); ++n) images *= leading[n];
  leading.insert(leading.end(), {std::max<std::size_t>(rows, 2), std::max<std::size_t>(columns, 2)});
  require_shape(file, name, tensor, leading);
  return {static_cast<int>(images), static_cast<int>(rows), static_cast<int>(columns), std::move(tensor)};
}

std::vector<double> read_ascending(const TensorFile& file, const std::string& name, const char* expected) {
  const FloatTensor tensor = file.floats(name, 1);
  std::vector<double> angles(tensor.values.begin(), tensor.values.end());
  if (std::adjacent_find(angles.begin(), angles.end(), std::greater_equal<>()) != angles.end()) {
    file.fail("field '" + name + "' must ascend" + expected);
  }
  return angles;
}

/// Empty if isotropic.
std::vector<double> read_phi_i(const TensorFile& file) {
  if (file.floats("phi_i", 1).shape[0] <= 2) return {};
  std::vector<double> phi_i = read_ascending(file, "phi_i", "");
  if (phi_i.back() - phi_i.front() > 2 * kPi + kFloatRounding) file.fail("field 'phi_i' spans more than a turn");
  return phi_i;
}

int read_folds(const TensorFile& file, const std::vector<double>& phi_i) {
  if (phi_i.empty()) return 1;
  const double folds = std::round(2 * kPi / (phi_i.back() - phi_i.front()));
  if (folds != 1 && folds != 2 && folds != 4) {
    file.fail("field 'phi_i' spans " + sklar::to_text((phi_i.back() - phi_i.front()) / kPi) +
              " pi, expected about 2, 1 or 0.5");
  }
  if (folds == 4 && std::abs(std::remainder(phi_i.front(), kPi / 2)) > kFloatRounding) {
    file.fail("field 'phi_i' spans a quarter of a turn and begins at " + sklar::to_text(phi_i.front() / kPi) +
              " pi, expected a multiple of 0.5");
  }
  return static_cast<int>(folds);
}

/// In [0,pi/2].
std::vector<double> read_theta_i(const TensorFile& file) {
  constexpr const char* kWithin = " within [0, pi/2]";
  std::vector<double> theta_i = read_ascending(file, "theta_i", kWithin);
  if (theta_i.front() < 0 || theta_i.back() > kPi / 2 + kFloatRounding) {
    file.fail(std::string("field 'theta_i' must ascend") + kWithin);
  }
  return theta_i;
}

std::vector<double> read_wavelengths(const TensorFile& file) {
  std::vector<double> wavelengths = read_ascending(file, "wavelengths", "");
  if (wavelengths.size() < 2) file.fail("field 'wavelengths' holds one value, expected 2 or more");
  return wavelengths;
}

/// `rgb`, or where a file has none the colours of `spectra`.
RglSlices read_rgb(const TensorFile& file) {
  const std::size_t azimuths = file.floats("phi_i", 1).shape[0];
  const std::size_t slices = file.floats("theta_i", 1).shape[0];
  const bool isotropic = azimuths <= 2;
  if (file.has("rgb") || !file.has("wavelengths")) return read_slices(file, "rgb", isotropic, {azimuths, slices, 3});
  const std::vector<Rgb> weights = rgb_weights(read_wavelengths(file));
  RglSlices spectra = read_slices(file, "spectra", isotropic, {azimuths, slices, weights.size()});
  const std::size_t nodes = static_cast<std::size_t>(spectra.rows) * static_cast<std::size_t>(spectra.columns);
  const std::size_t directions = spectra.values().size() / (nodes * weights.size());
  std::vector<float> rgb;
  rgb.reserve(3 * directions * nodes);
  for (std::size_t slice = 0; slice < directions; ++slice) {
    const std::size_t first = slice * weights.size() * nodes;
    for (int channel = 0; channel < 3; ++channel) {
      for (std::size_t node = 0; node < nodes; ++node) {
        double sum = 0;
        for (std::size_t n = 0; n < weights.size(); ++n) {
          sum += weights[n][channel] * static_cast<double>(spectra.tensor.values[first + n * nodes + node]);
        }
        rgb.push_back(static_cast<float>(sum));
      }
    }
  }
  return {static_cast<int>(3 * directions), spectra.rows, spectra.columns, {{}, std::move(rgb)}};
}

BilinearWarp read_warp(const TensorFile& file, bool isotropic, std::size_t slices) {
  const RglSlices vndf = read_slices(file, "vndf", isotropic, {file.floats("phi_i", 1).shape[0], slices});
  require_at_least(file, "vndf", vndf.tensor, 0, "0 or more");
  try {
    return {vndf.images, vndf.rows, vndf.columns, vndf.values()};
  } catch (const std::invalid_argument&) {
    file.fail("field 'vndf' has a slice without mass");
  }
}

double share_below_zero(std::span<const float> values) {
  const auto below = std::count_if(values.begin(), values.end(), [](float value) { return value < 0; });
  return static_cast<double>(below) / static_cast<double>(values.size());
}

double theta_to_unit(double theta) {
  return std::sqrt(2 * theta / kPi);
}

double phi_to_unit(double phi) {
  const double turns = phi / (2 * kPi) + 0.5;
  return turns - std::floor(turns);
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

RglMaterial::RglMaterial(const TensorFile& file) : RglMaterial(file, read_rgb(file)) {}

RglMaterial::RglMaterial(const TensorFile& file, const RglSlices& rgb)
    : phi_i_(read_phi_i(file)),
      folds_(read_folds(file, phi_i_)),
      theta_i_(read_theta_i(file)),
      jacobian_(file.byte("jacobian") != 0),
      negative_share_(share_below_zero(rgb.values())),
      ndf_(read_profile(file, "ndf", isotropic(), 0.0F, "0 or more")),
      sigma_(read_profile(file, "sigma", isotropic(), std::numeric_limits<float>::min(), "more than 0")),
      rgb_(rgb.images, rgb.rows, rgb.columns, rgb.values()),
      vndf_(read_warp(file, isotropic(), theta_i_.size())) {}

Rgb RglMaterial::f_cos(const Vec3& wo, const Vec3& wi) const {
  return isotropic() ? f_cos_isotropic(wo, wi) : f_cos_anisotropic(wo, wi);
}

Rgb RglMaterial::f_one_way(const Vec3& wo, const Vec3& wi) const {
  static const double kCosineFloor = std::cos(87.5 * kPi / 180);
  return (f_cos(wo, wi) / std::max(wo.z(), kCosineFloor)).max(0.0);
}

Rgb RglMaterial::value(const Vec2& u_half, const Vec2& u_wi, const ImageBlend& slice) const {
  const Vec2 s = vndf_.invert(u_half, slice);
  const auto& [low, high, share] = slice.within;
  Rgb result;
  for (int channel = 0; channel < 3; ++channel) {
    result[channel] = rgb_.at(s, {{3 * low + channel, 3 * high + channel, share}, 3 * slice.step, slice.share});
  }
  if (!jacobian_) return result;
  constexpr ImageBlend kOnly{{0, 0, 0}};
  return result * (ndf_.at(u_half, kOnly) / (4 * sigma_.at(u_wi, kOnly)));
}

Rgb RglMaterial::f_cos_isotropic(const Vec3& wo, const Vec3& wi) const {
  const Vec3 half = wi + wo;
  const double theta_i = polar_angle(wi);
  const double phi = std::atan2(half.y(), half.x()) - std::atan2(wi.y(), wi.x());
  return value({theta_to_unit(polar_angle(half)), phi_to_unit(phi)}, {theta_to_unit(theta_i), 0.5},
               {between_angles(theta_i_, theta_i)});
}

Rgb RglMaterial::f_cos_anisotropic(Vec3 wo, Vec3 wi) const {
  const auto flip = [&](bool x, bool y) {
    for (Vec3* w : {&wi, &wo}) *w = {x ? -w->x() : w->x(), y ? -w->y() : w->y(), w->z()};
  };
  if (folds_ == 2) {
    const bool other_half = phi_to_unit(std::atan2(wi.y(), wi.x()) - phi_i_.front() - kPi) >= 0.5;
    flip(other_half, other_half);
  } else if (folds_ == 4) {
    const double middle = phi_i_.front() + kPi / 4;
    flip((wi.x() < 0) != (std::cos(middle) < 0), (wi.y() < 0) != (std::sin(middle) < 0));
  }
  const Vec3 half = wi + wo;
  const double theta_i = polar_angle(wi);
  const double phi_i = std::atan2(wi.y(), wi.x());
  const Between row = between_azimuths(phi_i);
  const Between column = between_angles(theta_i_, theta_i);
  const auto slices = static_cast<int>(theta_i_.size());
  return value({theta_to_unit(polar_angle(half)), phi_to_unit(std::atan2(half.y(), half.x()))},
               {theta_to_unit(theta_i), phi_to_unit(phi_i)},
               {.within = {row.low * slices + column.low, row.low * slices + column.high, column.share},
                .step = (row.high - row.low) * slices,
                .share = row.share});
}

Between RglMaterial::between_azimuths(double phi) const {
  const double span = phi_i_.back() - phi_i_.front();
  const double ahead = 2 * kPi * phi_to_unit(phi - phi_i_.front() - kPi);  // in [0, 2 pi)
  if (ahead <= span) return between_angles(phi_i_, phi_i_.front() + ahead);
  // Between the last node and the first of the next turn, which one step of rounding or one of nodes sets apart.
  const auto last = static_cast<int>(phi_i_.size()) - 1;
  if (folds_ == 1) return {last, 0, (ahead - span) / (2 * kPi - span)};
  return ahead < kPi + span / 2 ? Between{last, last, 0} : Between{0, 0, 0};
}

}  // namespace sklar::brdf
