#include "brdf/basis/azimuthal_series.hpp"

#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <numbers>
#include <stdexcept>

#include "brdf/basis/fill.hpp"
#include "brdf/basis/info.hpp"
#include "brdf/data/table_brdf.hpp"
#include "brdf/geometry/frame.hpp"

namespace sklar::brdf {
namespace {

using Eigen::MatrixXd;

constexpr double kPi = std::numbers::pi;
constexpr int kThetas = 90, kAzimuths = 180;
constexpr double kRidge = 1e-6;
constexpr std::size_t kMostFunctions = RadialFunctions::kMostOrder + 1;

double cos_azimuths(const Vec3& a, const Vec3& b) {
  const double radii = std::sqrt((a.x() * a.x() + a.y() * a.y()) * (b.x() * b.x() + b.y() * b.y()));
  return radii > 0 ? std::clamp((a.x() * b.x() + a.y() * b.y()) / radii, -1.0, 1.0) : 1.0;
}

double theta_at(int n) {
  return (n + 0.5) / kThetas * kPi / 2;
}

}  // namespace

std::size_t SeriesShape::coefficients() const {
  std::size_t sum = 0;
  for (int m = 0; m <= order; ++m) {
    const auto n = static_cast<std::size_t>(radial.count(order, m));
    sum += symmetric ? n * (n + 1) / 2 : n * n;
  }
  return sum;
}

AzimuthalSeries::AzimuthalSeries(const SeriesShape& shape, std::array<HalfArray, 3> coefficients)
    : shape_(shape), coefficients_(std::move(coefficients)) {
  for (const HalfArray& channel : coefficients_) {
    if (channel.size() != shape_.coefficients()) {
      throw std::invalid_argument("AzimuthalSeries: " + std::to_string(channel.size()) + " coefficients, expected " +
                                  std::to_string(shape_.coefficients()));
    }
  }
}

Rgb AzimuthalSeries::sum(const Vec3& a, const Vec3& b) const {
  // Where symmetric, one order of the two makes exchanging them exact; with equal z the radial parts are equal.
  const bool turned = shape_.symmetric && a.z() < b.z();
  const Vec3 &first = turned ? b : a, &second = turned ? a : b;
  const double cosine = cos_azimuths(first, second);
  std::array<double, kMostFunctions> of_first, of_second;
  double now = 1, before = cosine;  // cos(m dphi) and cos((m - 1) dphi)
  Rgb sum = Rgb::Zero();
  std::size_t next = 0;
  for (int m = 0; m <= shape_.order; ++m) {
    shape_.radial.values(shape_.order, m, first, of_first.data());
    shape_.radial.values(shape_.order, m, second, of_second.data());
    const auto count = static_cast<std::size_t>(shape_.radial.count(shape_.order, m));
    Rgb of_m = Rgb::Zero();
    for (std::size_t j = 0; j < count; ++j) {
      for (std::size_t k = shape_.symmetric ? j : 0; k < count; ++k) {
        double product = of_first[j] * of_second[k];
        if (shape_.symmetric && k != j) product += of_first[k] * of_second[j];
        for (std::size_t c = 0; c < 3; ++c) of_m[static_cast<int>(c)] += coefficients_[c][next] * product;
        ++next;
      }
    }
    sum += of_m * now;
    const double after = 2 * cosine * now - before;
    before = now;
    now = after;
  }
  return sum;
}

namespace {

/// The Fourier cosine coefficients over dphi of f_r, or f_r cos_i, at each pair of polar angles (theta_i, theta_o): one
/// matrix for each m and channel.
std::vector<std::array<MatrixXd, 3>> azimuthal_parts(const TableBrdf& table, int order, bool f_cos) {
  std::vector<std::array<MatrixXd, 3>> parts(static_cast<std::size_t>(order) + 1);
  for (auto& part : parts) part.fill(MatrixXd::Zero(kThetas, kThetas));
  MatrixXd cosines(order + 1, kAzimuths);
  for (int m = 0; m <= order; ++m) {
    const double scale = (m == 0 ? 1.0 : 2.0) / kAzimuths;
    for (int n = 0; n < kAzimuths; ++n) cosines(m, n) = scale * std::cos(m * (n + 0.5) * kPi / kAzimuths);
  }
  tbb::parallel_for(0, kThetas, [&](int row) {
    const Vec3 wi = spherical_direction(theta_at(row), 0);
    Eigen::MatrixX3d values(kAzimuths, 3);
    for (int column = 0; column < kThetas; ++column) {
      for (int n = 0; n < kAzimuths; ++n) {
        const double phi = (n + 0.5) * kPi / kAzimuths;
        const double theta_o = theta_at(column);
        const Rgb f = 0.5 * (table.eval(spherical_direction(theta_o, phi), wi) +
                             table.eval(spherical_direction(theta_o, -phi), wi));
        values.row(n) = (f * (f_cos ? wi.z() : 1.0)).matrix().transpose();
      }
      const Eigen::MatrixX3d found = cosines * values;
      for (int m = 0; m <= order; ++m) {
        for (int c = 0; c < 3; ++c) {
          parts[static_cast<std::size_t>(m)][static_cast<std::size_t>(c)](row, column) = found(m, c);
        }
      }
    }
  });
  return parts;
}

/// The matrix that takes values on the polar angles to coefficients of R_m by weighted least squares with the ridge.
MatrixXd projection(const SeriesShape& shape, int m, bool with_cosine) {
  const int count = shape.radial.count(shape.order, m);
  MatrixXd radial(kThetas, count);
  Eigen::VectorXd weight(kThetas);
  std::array<double, kMostFunctions> values{};
  for (int n = 0; n < kThetas; ++n) {
    const Vec3 w = spherical_direction(theta_at(n), 0);
    shape.radial.values(shape.order, m, w, values.data());
    for (int j = 0; j < count; ++j) radial(n, j) = values[static_cast<std::size_t>(j)];
    weight[n] = w.x() * (with_cosine ? w.z() : 1.0);
  }
  const MatrixXd weighted = radial.transpose() * weight.asDiagonal();
  MatrixXd normal = weighted * radial;
  normal.diagonal().array() += kRidge * normal.trace() / count;
  return normal.ldlt().solve(weighted);
}

}  // namespace

AzimuthalSeries fit_series(const MeasuredTable& table, const SeriesShape& shape, bool f_cos) {
  const TableBrdf source(std::make_shared<const MeasuredTable>(filled(table)));
  const auto parts = azimuthal_parts(source, shape.order, f_cos);
  std::array<std::vector<double>, 3> coefficients;
  for (int m = 0; m <= shape.order; ++m) {
    const MatrixXd of_wi = projection(shape, m, !f_cos), of_wo = projection(shape, m, true);
    for (std::size_t c = 0; c < 3; ++c) {
      const MatrixXd found = of_wi * parts[static_cast<std::size_t>(m)][c] * of_wo.transpose();
      for (Eigen::Index j = 0; j < found.rows(); ++j) {
        for (Eigen::Index k = shape.symmetric ? j : 0; k < found.cols(); ++k) {
          coefficients[c].push_back(shape.symmetric ? 0.5 * (found(j, k) + found(k, j)) : found(j, k));
        }
      }
    }
  }
  return {shape, {HalfArray(coefficients[0]), HalfArray(coefficients[1]), HalfArray(coefficients[2])}};
}

SeriesShape largest_series(const char* model, const SeriesShape& most, double max_bytes) {
  SeriesShape shape = most;
  shape.order = 0;
  require_budget(model, static_cast<double>(shape.bytes()), max_bytes);
  for (SeriesShape next = shape; next.order <= most.order; ++next.order) {
    if (static_cast<double>(next.bytes()) <= max_bytes) shape = next;
  }
  return shape;
}

}  // namespace sklar::brdf
