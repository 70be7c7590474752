#include "brdf/study/image_metrics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "copula/error.hpp"

namespace sklar::brdf {
namespace {
using std::numbers::pi;

constexpr int kWindow = 11;
constexpr double kSigma = 1.5;

using Plane = Eigen::ArrayXXd;

/// Convolution with the separable Gaussian window, where it lies inside the picture.
Plane blur(const Plane& plane) {
  Eigen::ArrayXd kernel = (Eigen::ArrayXd::LinSpaced(kWindow, -5, 5) / kSigma).square() * -0.5;
  kernel = kernel.exp().eval();
  kernel /= kernel.sum();
  const Eigen::Index rows = plane.rows() - kWindow + 1;
  const Eigen::Index columns = plane.cols() - kWindow + 1;
  Plane down = Plane::Zero(rows, plane.cols());
  for (int k = 0; k < kWindow; ++k) down += kernel(k) * plane.middleRows(k, rows);
  Plane both = Plane::Zero(rows, columns);
  for (int k = 0; k < kWindow; ++k) both += kernel(k) * down.middleCols(k, columns);
  return both;
}

double ssim(const Plane& a, const Plane& b) {
  constexpr double kC1 = 0.01 * 0.01;
  constexpr double kC2 = 0.03 * 0.03;
  const Plane mean_a = blur(a);
  const Plane mean_b = blur(b);
  const Plane variance_a = blur(a.square()) - mean_a.square();
  const Plane variance_b = blur(b.square()) - mean_b.square();
  const Plane covariance = blur(a * b) - mean_a * mean_b;
  return (((2 * mean_a * mean_b + kC1) * (2 * covariance + kC2)) /
          ((mean_a.square() + mean_b.square() + kC1) * (variance_a + variance_b + kC2)))
      .mean();
}

/// The picture as n x 3 displayed linear values in [0,1], in the order of Image; NaN counts as 0.
RgbRows displayed(const Image& image, double exposure) {
  RgbRows pixels(image.width * image.height, 3);
  for (Eigen::Index n = 0; n < pixels.rows(); ++n) {
    for (Eigen::Index c = 0; c < 3; ++c) {
      const double value = exposure * image.rgb[static_cast<std::size_t>(3 * n + c)];
      pixels(n, c) = value > 0 ? std::min(value, 1.0) : 0.0;
    }
  }
  return pixels;
}

Plane luma(const RgbRows& encoded, const Image& image) {
  const Eigen::ArrayXd y = 0.299 * encoded.col(0) + 0.587 * encoded.col(1) + 0.114 * encoded.col(2);
  return Eigen::Map<const Plane>(y.data(), image.width, image.height);
}

double atan2_degrees(double y, double x) {
  if (x == 0 && y == 0) return 0;
  const double degrees = std::atan2(y, x) * 180 / pi;
  return degrees < 0 ? degrees + 360 : degrees;
}

double cos_degrees(double degrees) {
  return std::cos(degrees * pi / 180);
}
double sin_degrees(double degrees) {
  return std::sin(degrees * pi / 180);
}

}  // namespace

ImageErrors image_errors(const Image& reference, const Image& model, double exposure) {
  const auto size = [](const Image& image) {
    return std::to_string(image.width) + " x " + std::to_string(image.height);
  };
  if (reference.width != model.width || reference.height != model.height) {
    throw std::invalid_argument("image_errors: reference is " + size(reference) + ", model " + size(model) +
                                "; they must agree");
  }
  if (std::min(reference.width, reference.height) < kWindow) {
    throw std::invalid_argument("image_errors: pictures must be at least 11 x 11, got " + size(reference));
  }
  if (!(exposure > 0)) throw std::invalid_argument("image_errors: exposure must be positive, got " + to_text(exposure));
  const RgbRows a = displayed(reference, exposure);
  const RgbRows b = displayed(model, exposure);
  const RgbRows encoded_a = a.pow(1 / 2.2);
  const RgbRows encoded_b = b.pow(1 / 2.2);
  const double error = (encoded_a - encoded_b).square().mean();
  double difference = 0;
  for (Eigen::Index n = 0; n < a.rows(); ++n) {
    if ((a.row(n) == b.row(n)).all()) continue;
    difference += delta_e_2000(to_lab(a.row(n).transpose()), to_lab(b.row(n).transpose()));
  }
  return {.psnr_gamma_db = error > 0 ? -10 * std::log10(error) : std::numeric_limits<double>::infinity(),
          .ssim = ssim(luma(encoded_a, reference), luma(encoded_b, model)),
          .delta_e_2000 = difference / static_cast<double>(a.rows())};
}

Eigen::Array3d to_lab(const Rgb& linear) {
  // IEC 61966-2-1 primaries; the white point is the row sums, so that white has a* = b* = 0 exactly.
  const Eigen::Array33d to_xyz = (Eigen::Array33d() << 0.4124564, 0.3575761, 0.1804375,  //
                                  0.2126729, 0.7151522, 0.0721750,                       //
                                  0.0193339, 0.1191920, 0.9503041)
                                     .finished();
  const Eigen::Array3d white = to_xyz.rowwise().sum();
  const Eigen::Array3d xyz = (to_xyz.matrix() * linear.matrix()).array() / white;
  const auto root = [](double t) {
    constexpr double kDelta = 6.0 / 29.0;
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0 / 29.0;
  };
  const Eigen::Array3d f = xyz.unaryExpr(root);
  return {116 * f.y() - 16, 500 * (f.x() - f.y()), 200 * (f.y() - f.z())};
}

double delta_e_2000(const Eigen::Array3d& first, const Eigen::Array3d& second) {
  constexpr double k25To7 = 6103515625.0;  // 25^7
  const auto chroma_weight = [](double chroma) {
    const double seventh = std::pow(chroma, 7);
    return std::sqrt(seventh / (seventh + k25To7));
  };
  const double mean_chroma = (std::hypot(first[1], first[2]) + std::hypot(second[1], second[2])) / 2;
  const double stretch = 1.5 - 0.5 * chroma_weight(mean_chroma);
  const double c1 = std::hypot(stretch * first[1], first[2]);
  const double c2 = std::hypot(stretch * second[1], second[2]);
  const double h1 = atan2_degrees(first[2], stretch * first[1]);
  const double h2 = atan2_degrees(second[2], stretch * second[1]);

  const bool grey = c1 * c2 == 0;
  double turn = grey ? 0 : h2 - h1;
  if (turn > 180) turn -= 360;
  if (turn < -180) turn += 360;
  const double lightness = second[0] - first[0];
  const double chroma = c2 - c1;
  const double hue = 2 * std::sqrt(c1 * c2) * sin_degrees(turn / 2);

  const double l = (first[0] + second[0]) / 2;
  const double c = (c1 + c2) / 2;
  double h = h1 + h2;
  if (!grey) {
    if (std::abs(h1 - h2) > 180) h += h < 360 ? 360 : -360;
    h /= 2;
  }
  const double t = 1 - 0.17 * cos_degrees(h - 30) + 0.24 * cos_degrees(2 * h) + 0.32 * cos_degrees(3 * h + 6) -
                   0.20 * cos_degrees(4 * h - 63);
  const double rotation = 30 * std::exp(-std::pow((h - 275) / 25, 2));
  const double square = (l - 50) * (l - 50);
  const double by_lightness = lightness / (1 + 0.015 * square / std::sqrt(20 + square));
  const double by_chroma = chroma / (1 + 0.045 * c);
  const double by_hue = hue / (1 + 0.015 * c * t);
  const double cross = -sin_degrees(2 * rotation) * 2 * chroma_weight(c);
  return std::sqrt(by_lightness * by_lightness + by_chroma * by_chroma + by_hue * by_hue + cross * by_chroma * by_hue);
}

}  // namespace sklar::brdf
