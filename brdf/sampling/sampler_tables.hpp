#pragma once
/// The tables of a ConditionalSampler. Component 0 is a density of (radius2, azimuth), the others are densities of
/// (slope2, half_azimuth); see WiCoordinates. Given theta_o each is made of two margins and a copula.
///
/// The polar coordinate of component k > 0 is x = slope2 / (slope2 + width_k^2), which the normals of a GGX surface of
/// roughness width_k would make uniform; that of component 0 is radius2. Margins are continuous, linear between knots;
/// they, the shares and the dependence are linear between the nodes of theta_o.

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace sklar::brdf {

inline constexpr std::size_t kSamplerComponents = 4;
inline constexpr std::size_t kPolarKnots = 16;
inline constexpr std::size_t kAzimuthKnots = 13;  ///< odd: a knot at phi = pi/2, where FoldedAzimuth has its kink
inline constexpr int kOutgoingNodes = 17;

/// A margin at its knots: density, cdf, density, cdf, ..; so that two knots are four numbers side by side.
template <std::size_t Knots>
using MarginRow = std::array<float, 2 * Knots>;

/// What is known at one theta_o.
struct SamplerNode {
  std::array<MarginRow<kPolarKnots>, kSamplerComponents> polar;
  std::array<MarginRow<kAzimuthKnots>, kSamplerComponents> azimuth;
  std::array<float, kSamplerComponents> share;       ///< sum 1
  std::array<float, kSamplerComponents> dependence;  ///< theta of the Ali-Mikhail-Haq copula; see sampler_copula.hpp
};

struct SamplerTables {
  std::vector<SamplerNode> nodes;                   ///< kOutgoingNodes
  std::array<double, kSamplerComponents> width2{};  ///< [0] is 1

  [[nodiscard]] std::size_t bytes() const { return nodes.size() * sizeof(SamplerNode) + sizeof width2; }
};

/// Where theta_o lies between the nodes, which are equidistant in (1 - sqrt(cos) + sqrt(1 - cos)) / 2: dense towards
/// grazing, where the horizon cuts into the lobes.
struct OutgoingPlace {
  int node;
  float share;  ///< of the next node

  explicit OutgoingPlace(double cosine) {
    const double c = std::min(cosine, 1.0);
    const double position = (1 - std::sqrt(c) + std::sqrt(1 - c)) / 2 * (kOutgoingNodes - 1);
    node = std::min(static_cast<int>(position), kOutgoingNodes - 2);
    share = static_cast<float>(position - node);
  }

  /// cos(theta_o) of a node.
  [[nodiscard]] static double cosine_at(int node) {
    const double b = 2.0 * node / (kOutgoingNodes - 1) - 1, root = (std::sqrt(2 - b * b) - b) / 2;
    return root * root;
  }
};

}  // namespace sklar::brdf
