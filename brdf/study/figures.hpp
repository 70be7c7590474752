#pragma once
/// The paper's figures for any material and models: spheres with differences (Fig. 3), margins (Fig. 1), joint density
/// (Fig. 2) and albedo (Fig. 5).

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "brdf/render/sphere.hpp"
#include "brdf/study/albedo.hpp"
#include "brdf/study/metrics.hpp"

namespace sklar::brdf {

/// What the figures and the image measures need of one reflectance, computed once.
struct View {
  std::string name;  ///< as the legends show it
  CellValues cells;  ///< at the valid cells of the reference table
  Image sphere;
  AlbedoCurve albedo;
};

/// @param reference the table whose valid cells are evaluated.
[[nodiscard]] View view(std::string name, const Brdf& brdf, const MeasuredTable& reference,
                        const SphereOptions& options = {});

/// The view of the table itself, named after its provenance.
[[nodiscard]] View view(const std::shared_ptr<const MeasuredTable>& reference, const SphereOptions& options = {});

/// Empirical margins and joint density: shares of a plane's sum over its cells (the paper's Eqs. 9 to 12); zeros for a
/// black plane.
struct CellShares {
  Eigen::ArrayXXd joint = {};  ///< theta_h along rows, theta_d along columns
  Eigen::ArrayXd theta_h = {}, theta_d = {}, phi_d = {};
};

/// @param plane Grid::cells values >= 0. @throws std::invalid_argument
[[nodiscard]] CellShares cell_shares(const std::vector<double>& plane);

/// The exposure at which 95 % of the pixels that differ from the corner (the background) are at most 0.8 in every
/// channel; 1 for a picture that is all background or black.
[[nodiscard]] double display_exposure(const Image& reference);

/// The mean absolute difference of the displayed sRGB values of a pixel, times gain, in viridis.
[[nodiscard]] Bytes false_colour_difference(const Image& reference, const Image& model, double exposure, double gain);

/// A column of the figure.
struct SpherePair {
  std::string label;
  const Image* reference;
  const Image* model;
};

/// Rows: reference, model with PSNR and SSIM, difference times five with Delta-E; a column for each pair, shown at the
/// display exposure of its reference. @throws as write_grid and image_errors.
void write_sphere_figure(const std::filesystem::path& path, const std::string& title,
                         std::span<const SpherePair> columns);

/// cell_shares of the green channel in theta_h, theta_d and phi_d.
void write_margin_figure(const std::filesystem::path& path, const std::string& title, const View& reference,
                         std::span<const View> models);

/// cell_shares of the green channel in (theta_d, theta_h), five decades of colour.
void write_joint_figure(const std::filesystem::path& path, const std::string& title, const View& reference,
                        std::span<const View> models);

/// Directional albedo against theta_o, a panel for each channel.
void write_albedo_figure(const std::filesystem::path& path, const std::string& title, const View& reference,
                         std::span<const View> models);

/// All four as FOLDER/NAME_spheres.png, _margins.png, _joint.png, _albedo.png; the folder must exist.
/// @param title of every figure. @return the paths.
std::vector<std::filesystem::path> write_figures(const std::filesystem::path& folder, const std::string& name,
                                                 const std::string& title, const View& reference,
                                                 std::span<const View> models);

}  // namespace sklar::brdf
