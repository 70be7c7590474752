#pragma once
/// The tables of a ConditionalSampler: a mixture of six densities, each the product of two margins. Those of the half
/// vector are over the disk of m (polar coordinate: DiskWarp, azimuth: FoldedAzimuth), those of wi over radius2 and its
/// azimuth; see WiCoordinates. Margins are continuous, linear between equidistant knots; they, the shares and the
/// spread of the warp are linear in cos(theta_o) between its nodes.

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace sklar::brdf {

/// One of the two kinds of components: how many, and the cells of their margins.
struct SamplerKind {
  std::size_t components, polar_cells, azimuth_cells;
};
inline constexpr SamplerKind kOfHalf{4, 16,
                                     12};  ///< even azimuth cells: a knot at phi = pi/2, the kink of FoldedAzimuth
/// Components over wi; of both kinds; nodes of theta_o.
inline constexpr SamplerKind kOfWi{2, 8, 8};
inline constexpr std::size_t kSamplerComponents = kOfHalf.components + kOfWi.components;
inline constexpr int kOutgoingNodes = 13;

/// Margins of some components: densities at the knots, components side by side, and the cdf at the upper ends of the
/// cells, the last of them 1.
template <std::size_t Components, std::size_t Cells>
struct MarginTable {
  std::array<std::array<float, Components>, Cells + 1> density;
  std::array<std::array<float, Cells>, Components> cdf;
};

/// What is known at one theta_o.
struct SamplerNode {
  MarginTable<kOfHalf.components, kOfHalf.polar_cells> half_polar;
  MarginTable<kOfHalf.components, kOfHalf.azimuth_cells> half_azimuth;
  MarginTable<kOfWi.components, kOfWi.polar_cells> wi_polar;
  MarginTable<kOfWi.components, kOfWi.azimuth_cells> wi_azimuth;
  std::array<float, kSamplerComponents + 3> shares;  ///< 0, then running sums; 1 in the end
  float spread;                                      ///< of DiskWarp
};

struct SamplerTables {
  std::vector<SamplerNode> nodes;  ///< kOutgoingNodes

  [[nodiscard]] std::size_t bytes() const { return nodes.size() * sizeof(SamplerNode); }
};

/// cos(theta_o) of the nodes: dense at grazing, where the light changes most, and at the normal, where it loses the
/// symmetry about it. The numbers between are linear in the cosine.
inline constexpr std::array<float, kOutgoingNodes> kOutgoingCosines = {
    1, 0.998F, 0.955F, 0.84F, 0.67F, 0.5F, 0.37F, 0.28F, 0.22F, 0.174F, 0.13F, 0.085F, 0};

}  // namespace sklar::brdf
