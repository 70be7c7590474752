#include "brdf/model/warp.hpp"

#include <cmath>

namespace sklar::brdf {

Warped warp(double width, const Vec3& wo, const Vec3& wi) {
  const Vec3 sum = wi + wo;
  const Vec3 difference = wi - wo;
  const double square = sum.squaredNorm();
  const double sin2_d = difference.squaredNorm() / 4;
  const double sin2_h = (sum.x() * sum.x() + sum.y() * sum.y()) / square;
  const double versed_h = sin2_h / (1 + sum.z() / std::sqrt(square));
  const double reach = sin2_h * sin2_d;
  return {.half = std::sqrt(std::sqrt(versed_h * (1 + width) / (versed_h + width))),
          .difference = 1 - std::sqrt(square / 4 / (1 + std::sqrt(sin2_d))),
          .azimuth = difference.z() * difference.z() / 4 / (reach + kPole)};
}

}  // namespace sklar::brdf
