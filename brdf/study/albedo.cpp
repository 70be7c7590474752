#include "brdf/study/albedo.hpp"

#include <tbb/parallel_for.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace sklar::brdf {

Eigen::ArrayXd albedo_angles() {
  return Eigen::ArrayXd::LinSpaced(90, 0, 89) * (std::numbers::pi / 180);
}

AlbedoCurve directional_albedo(const Brdf& brdf, const Eigen::ArrayXd& theta_o, const HemisphereOptions& nodes) {
  if (!brdf.traits().isotropic) throw std::invalid_argument("directional_albedo: the BRDF must be isotropic");
  AlbedoCurve curve{theta_o, RgbRows(theta_o.size(), 3)};
  tbb::parallel_for(Eigen::Index{0}, theta_o.size(), [&](Eigen::Index row) {
    const HemisphereNodes quadrature = hemisphere_nodes(theta_o(row), nodes);
    Directions wo(quadrature.wi.rows(), 3);
    wo.rowwise() = Eigen::Array<double, 1, 3>(std::sin(theta_o(row)), 0, std::cos(theta_o(row)));
    curve.albedo.row(row) = (brdf.eval(wo, quadrature.wi).colwise() * quadrature.weight).colwise().sum();
  });
  return curve;
}

}  // namespace sklar::brdf
