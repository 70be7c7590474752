#include "brdf/basis/nmf.hpp"

#include <algorithm>
#include <numbers>
#include <stdexcept>

#include "brdf/basis/fill.hpp"
#include "brdf/basis/nmf_fit.hpp"
#include "brdf/data/table_brdf.hpp"
#include "brdf/geometry/frame.hpp"
#include "brdf/luminance.hpp"

namespace sklar::brdf {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kLargestTheta = 89 * kPi / 180;          ///< of the last theta_o node
constexpr double kLeastCosine = 0.017452406437283512819;  ///< cos 89 deg

double theta_h_node(int n, int nodes) {
  const double x = n / (nodes - 1.0);
  return x * x * kPi / 2;
}

/// The half vector as the factors see it.
struct HalfPosition {
  Between theta, phi;
};

/// Azimuth of wo as a unit vector; x where wo is the normal.
Vec2 azimuth(const Vec3& wo) {
  const double radius = std::sqrt(wo.x() * wo.x() + wo.y() * wo.y());
  return radius > 0 ? Vec2(wo.x() / radius, wo.y() / radius) : Vec2(1, 0);
}

HalfPosition half_position(const Vec3& wo, const Vec3& half, const NmfNodes& nodes) {
  const Vec2 x = azimuth(wo);
  const double along = half.x() * x.x() + half.y() * x.y();
  const double across = half.y() * x.x() - half.x() * x.y();
  const double theta = std::sqrt(polar_angle(half) / (kPi / 2));
  return {between_clamped(theta * (nodes.theta_h - 1), nodes.theta_h),
          between_clamped(std::atan2(std::abs(across), along) / kPi * (nodes.phi_h - 1), nodes.phi_h)};
}

Between outer_position(const Vec3& wo, const NmfNodes& nodes) {
  return between_clamped(polar_angle(wo) / kLargestTheta * (nodes.theta_o - 1), nodes.theta_o);
}

double at(const HalfArray& values, const Between& where) {
  return mix(values[static_cast<std::size_t>(where.low)], values[static_cast<std::size_t>(where.high)], where.share);
}

/// What is drawn between two nodes.
double between_nodes(const HalfArray& values, int low) {
  const auto n = static_cast<std::size_t>(low);
  return 0.5 * (values[n] + values[n + 1]);
}

/// Solid angle per radian of azimuth between theta_h nodes n and n + 1.
double ring(int n, int nodes) {
  return std::cos(theta_h_node(n, nodes)) - std::cos(theta_h_node(n + 1, nodes));
}

struct Bin {
  int low;
  double share;  ///< of the uniform within the bin, [0,1]
};

/// The bin that a uniform falls in when bin n has mass(n).
template <class Mass>
Bin draw_bin(int bins, double uniform, const Mass& mass) {
  double total = 0;
  for (int n = 0; n < bins; ++n) total += mass(n);
  double rest = uniform * total;
  int last = 0;
  for (int n = 0; n < bins; ++n) {
    const double here = mass(n);
    if (!(here > 0)) continue;
    if (rest < here) return {n, rest / here};
    rest -= here;
    last = n;
  }
  return {last, 1.0};
}

}  // namespace

Nmf::Nmf(const NmfNodes& nodes, std::vector<Outer> terms) : nodes_(nodes), terms_(std::move(terms)) {
  const auto require = [](const HalfArray& values, int size) {
    bool sound = values.size() == static_cast<std::size_t>(size);
    for (std::size_t n = 0; n < values.size(); ++n) sound = sound && values[n] >= 0;
    if (!sound) throw std::invalid_argument("Nmf: a factor is not sized as the nodes or negative");
  };
  bytes_ = 6;
  for (const Outer& outer : terms_) {
    require(outer.f, 3 * nodes.theta_o);
    bytes_ += outer.f.bytes();
    for (const Inner& inner : outer.inner) {
      require(inner.u, nodes.theta_h);
      require(inner.v, nodes.phi_h);
      bytes_ += inner.u.bytes() + inner.v.bytes() + sizeof(double);
      double over_theta = 0, over_phi = 0;
      for (int n = 0; n + 1 < nodes.theta_h; ++n) over_theta += between_nodes(inner.u, n) * ring(n, nodes.theta_h);
      for (int n = 0; n + 1 < nodes.phi_h; ++n) over_phi += between_nodes(inner.v, n);
      mass_.push_back(over_theta * over_phi * 2 * kPi / (nodes.phi_h - 1));
    }
  }
}

Rgb Nmf::outer_value(const Outer& outer, const Between& theta_o) const {
  Rgb value;
  for (int channel = 0; channel < 3; ++channel) {
    const int first = channel * nodes_.theta_o;
    value[channel] = at(outer.f, {first + theta_o.low, first + theta_o.high, theta_o.share});
  }
  return value;
}

Rgb Nmf::eval(const Vec3& wo, const Vec3& wi) const {
  if (!(wo.z() > 0 && wi.z() > 0)) return Rgb::Zero();
  const Between theta_o = outer_position(wo, nodes_);
  const HalfPosition half = half_position(wo, wi + wo, nodes_);
  Rgb sum = Rgb::Zero();
  for (const Outer& outer : terms_) {
    double of_half = 0;
    for (const Inner& inner : outer.inner) of_half += at(inner.u, half.theta) * at(inner.v, half.phi);
    sum += outer_value(outer, theta_o) * of_half;
  }
  return sum / std::max(wi.z(), kLeastCosine);
}

double Nmf::total_mass(const Between& theta_o) const {
  double total = 0;
  std::size_t term = 0;
  for (const Outer& outer : terms_) {
    const double strength = luminance(outer_value(outer, theta_o));
    for (std::size_t k = 0; k < outer.inner.size(); ++k) total += strength * mass_[term++];
  }
  return total;
}

double Nmf::pdf(const Vec3& wo, const Vec3& wi) const {
  if (!(wo.z() > 0 && wi.z() > 0)) return 0;
  const Between theta_o = outer_position(wo, nodes_);
  const double total = total_mass(theta_o);
  if (!(total > 0)) return Brdf::pdf(wo, wi);
  const Vec3 half = wi + wo;
  const HalfPosition where = half_position(wo, half, nodes_);
  double density = 0;
  for (const Outer& outer : terms_) {
    double of_half = 0;
    for (const Inner& inner : outer.inner) {
      of_half += between_nodes(inner.u, where.theta.low) * between_nodes(inner.v, where.phi.low);
    }
    density += luminance(outer_value(outer, theta_o)) * of_half;
  }
  return density / total * half.norm() / (4 * half.dot(wo));
}

Vec3 Nmf::draw_half(const Inner& inner, const Vec3& wo, const Vec2& uniforms) const {
  const Bin theta = draw_bin(nodes_.theta_h - 1, uniforms.x(),
                             [&](int n) { return between_nodes(inner.u, n) * ring(n, nodes_.theta_h); });
  const double side = uniforms.y() < 0.5 ? 1 : -1;
  const double stretched = side > 0 ? 2 * uniforms.y() : 2 * uniforms.y() - 1;
  const Bin phi = draw_bin(nodes_.phi_h - 1, stretched, [&](int n) { return between_nodes(inner.v, n); });
  // 1 - cos keeps its digits near the normal.
  const auto versine = [&](int n) {
    const double sine = std::sin(0.5 * theta_h_node(n, nodes_.theta_h));
    return 2 * sine * sine;
  };
  const double v = mix(versine(theta.low), versine(theta.low + 1), theta.share);
  const double sine = std::sqrt(v * (2 - v)), angle = side * (phi.low + phi.share) * kPi / (nodes_.phi_h - 1);
  const Vec2 x = azimuth(wo);
  const double along = sine * std::cos(angle), across = sine * std::sin(angle);
  return {along * x.x() - across * x.y(), along * x.y() + across * x.x(), 1 - v};
}

Vec3 Nmf::sample_direction(const Vec3& wo, const Vec2& uniforms) const {
  const Between theta_o = outer_position(wo, nodes_);
  const double total = total_mass(theta_o);
  if (!(total > 0)) return Brdf::sample_direction(wo, uniforms);
  double rest = uniforms.x() * total;
  double share = 1;
  bool found = false;
  const Inner* chosen = nullptr;
  std::size_t term = 0;
  for (const Outer& outer : terms_) {
    const double strength = luminance(outer_value(outer, theta_o));
    for (const Inner& inner : outer.inner) {
      const double here = strength * mass_[term++];
      if (found || !(here > 0)) continue;
      chosen = &inner;  // the last one stays where rounding leaves a rest
      found = rest < here;
      if (found) share = rest / here;
      rest -= here;
    }
  }
  const Vec3 half = draw_half(*chosen, wo, {share, uniforms.y()});
  return 2 * wo.dot(half) * half - wo;
}

namespace basis::nmf {
namespace {

/// The sizes that a budget chooses from.
struct Structure {
  NmfNodes nodes;
  int outer, inner;

  [[nodiscard]] double bytes() const {
    const auto array = [](int count) { return HalfArray::bytes(static_cast<std::size_t>(count)); };
    const std::size_t term = array(nodes.theta_h) + array(nodes.phi_h) + sizeof(double);
    return static_cast<double>(6 + static_cast<std::size_t>(outer) *
                                       (array(3 * nodes.theta_o) + static_cast<std::size_t>(inner) * term));
  }
};

/// From small to large; each refines the one before it in turn.
constexpr Structure kStructures[] = {
    {{8, 16, 5}, 1, 1},    {{8, 24, 9}, 1, 1},    {{8, 32, 9}, 2, 1},    {{12, 45, 9}, 2, 1},
    {{12, 45, 9}, 3, 1},   {{16, 45, 17}, 3, 1},  {{12, 45, 9}, 3, 2},   {{16, 60, 17}, 4, 1},
    {{16, 60, 17}, 4, 2},  {{16, 90, 17}, 6, 2},  {{24, 90, 17}, 8, 2},  {{24, 90, 33}, 8, 3},
    {{24, 90, 33}, 12, 3}, {{32, 90, 33}, 16, 4}, {{32, 90, 65}, 24, 6}, {{32, 90, 65}, 32, 8}};

/// f_r cos_i on the nodes: rows (channel, theta_o), columns (theta_h, phi_h) with phi_h fastest.
struct Target {
  Eigen::MatrixXd values, weights;
};

constexpr double kBelowHorizon = 0.01;  ///< weight of a node that only interpolation up to the horizon reads

Target target_of(const TableBrdf& table, const NmfNodes& nodes) {
  Target target;
  const Eigen::Index rows = Eigen::Index{3} * nodes.theta_o, columns = Eigen::Index{nodes.theta_h} * nodes.phi_h;
  target.values.setZero(rows, columns);
  target.weights.setConstant(rows, columns, kBelowHorizon);
  for (int a = 0; a < nodes.theta_o; ++a) {
    const Vec3 wo = spherical_direction(a * kLargestTheta / (nodes.theta_o - 1), 0);
    for (int b = 0; b < nodes.theta_h; ++b) {
      for (int c = 0; c < nodes.phi_h; ++c) {
        const double theta = theta_h_node(b, nodes.theta_h), phi = c * kPi / (nodes.phi_h - 1);
        const auto reflected = [&](double azimuth) -> Vec3 {
          const Vec3 half = spherical_direction(theta, azimuth);
          return 2 * wo.dot(half) * half - wo;
        };
        const Vec3 wi = reflected(phi);
        const bool above = wi.z() > 0;
        const Rgb value = 0.5 * wi.z() * (table.eval(wo, wi) + table.eval(wo, reflected(-phi)));
        for (int channel = 0; channel < 3; ++channel) {
          const int row = channel * nodes.theta_o + a, column = b * nodes.phi_h + c;
          // Below the horizon the value of the node before goes on; theta_h = 0 is above it.
          target.values(row, column) = above ? value[channel] : target.values(row, column - nodes.phi_h);
          if (above) target.weights(row, column) = 1;
        }
      }
    }
  }
  return target;
}

BrdfPtr fit_structure(const TableBrdf& table, const Structure& structure) {
  const Target target = target_of(table, structure.nodes);
  const SeparatedFactors factors =
      separated_factors(target.values, target.weights, structure.outer, structure.nodes.theta_h, structure.inner);
  const auto column = [](const Eigen::MatrixXd& matrix, Eigen::Index n) {
    return HalfArray(std::span(matrix.col(n).data(), static_cast<std::size_t>(matrix.rows())));
  };
  std::vector<Nmf::Outer> terms;
  for (int j = 0; j < structure.outer; ++j) {
    Nmf::Outer outer{.f = column(factors.outer, j), .inner = {}};
    const auto n = static_cast<std::size_t>(j);
    for (int k = 0; k < structure.inner; ++k) outer.inner.push_back({column(factors.u[n], k), column(factors.v[n], k)});
    terms.push_back(std::move(outer));
  }
  return std::make_shared<const Nmf>(structure.nodes, std::move(terms));
}

/// The largest structure that fits.
BrdfPtr fit(const BasisData& data, double max_bytes) {
  require_budget("nmf", kStructures[0].bytes(), max_bytes);
  const Structure* chosen = &kStructures[0];
  for (const Structure& structure : kStructures) {
    if (structure.bytes() <= max_bytes) chosen = &structure;
  }
  return fit_structure(TableBrdf(std::make_shared<const MeasuredTable>(filled(data.table))), *chosen);
}

}  // namespace

BasisInfo info() {
  return {.name = "nmf",
          .title = "Non-negative factors",
          .source =
              "Lawrence, Rusinkiewicz and Ramamoorthi 2004, Efficient BRDF Importance Sampling Using a Factored "
              "Representation",
          .fit_unchecked = fit};
}

}  // namespace basis::nmf
}  // namespace sklar::brdf
