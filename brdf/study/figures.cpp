#include "brdf/study/figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "brdf/data/table_brdf.hpp"
#include "brdf/study/image_metrics.hpp"
#include "copula/plot/plot.hpp"

namespace sklar::brdf {
namespace {

using plot::Axis;
using plot::Colour;
using plot::HeatMap;
using plot::ImageGrid;
using plot::Line;
using plot::LinePlot;
using plot::Page;
using plot::Panel;
using plot::Scale;

constexpr double kGain = 5;
constexpr std::size_t kGreen = 1;
constexpr double kDegree = std::numbers::pi / 180;
constexpr double kDecades = 5;  ///< of the joint density's colours

std::string fixed(double value, int digits) {
  if (!std::isfinite(value)) return value > 0 ? "\u221e" : "undefined";
  const double scale = std::pow(10, digits);
  std::string text = std::to_string(std::round(value * scale) / scale);
  return text.substr(0, text.find('.') + 1 + static_cast<std::size_t>(digits));
}

Axis degrees(const std::string& symbol, double high, std::vector<double> ticks, Scale scale = Scale::linear) {
  return {.label = symbol + " (degrees)", .scale = scale, .low = 0, .high = high, .ticks = std::move(ticks)};
}

Axis theta_h_axis() {
  return degrees("\u03b8_{h}", 90, {0, 1, 5, 15, 30, 60, 90}, Scale::square_root);
}

std::vector<const View*> reference_and(const View& reference, std::span<const View> models) {
  std::vector<const View*> all{&reference};
  for (const View& model : models) all.push_back(&model);
  return all;
}

/// The reference is wide and black, below the models, which are thin and in colour, every other one dashed: so curves
/// that agree all show.
Line styled(const std::string& label, std::size_t index) {
  if (index == 0) return {.label = label, .width = 3.6};
  return {.label = label, .colour = plot::series_colour(index - 1), .dashed = index % 2 == 0};
}

Line margin(const View& view, std::size_t index, const Eigen::ArrayXd& share, double (*centre)(int)) {
  Line line = styled(view.name, index);
  for (Eigen::Index n = 0; n < share.size(); ++n) {
    line.x.push_back(centre(static_cast<int>(n)) / kDegree);
    line.y.push_back(share(n));
  }
  return line;
}

std::string provenance_name(const MeasuredTable& table) {
  return table.provenance == Provenance::unknown ? "reference" : to_text(table.provenance);
}

}  // namespace

CellShares cell_shares(const std::vector<double>& plane) {
  if (plane.size() != Grid::cells) {
    throw std::invalid_argument("cell_shares: the plane has " + std::to_string(plane.size()) + " cells, expected " +
                                std::to_string(Grid::cells));
  }
  CellShares shares{.joint = Eigen::ArrayXXd(Grid::theta_h, Grid::theta_d), .phi_d = Eigen::ArrayXd::Zero(Grid::phi_d)};
  for (int i = 0; i < Grid::theta_h; ++i) {
    for (int j = 0; j < Grid::theta_d; ++j) {
      const Eigen::Map<const Eigen::ArrayXd> row(plane.data() + Grid::index(i, j, 0), Grid::phi_d);
      shares.joint(i, j) = row.sum();
      shares.phi_d += row;
    }
  }
  const double sum = shares.phi_d.sum();
  if (sum > 0) {
    shares.joint /= sum;
    shares.phi_d /= sum;
  }
  shares.theta_h = shares.joint.rowwise().sum();
  shares.theta_d = shares.joint.colwise().sum();
  return shares;
}

View view(std::string name, const Brdf& brdf, const MeasuredTable& reference, const SphereOptions& options) {
  return {.name = std::move(name),
          .cells = predict(brdf, reference),
          .sphere = render_sphere(brdf, options),
          .albedo = directional_albedo(brdf)};
}

View view(const std::shared_ptr<const MeasuredTable>& reference, const SphereOptions& options) {
  const TableBrdf brdf(reference);
  return {.name = provenance_name(*reference),
          .cells = reference->values,
          .sphere = render_sphere(brdf, options),
          .albedo = directional_albedo(brdf)};
}

double display_exposure(const Image& reference) {
  std::vector<float> brightest;
  for (std::size_t n = 0; n < reference.rgb.size(); n += 3) {
    if (std::equal(&reference.rgb[n], &reference.rgb[n] + 3, reference.rgb.data())) continue;
    brightest.push_back(std::max({reference.rgb[n], reference.rgb[n + 1], reference.rgb[n + 2]}));
  }
  if (brightest.empty()) return 1;
  const auto place = brightest.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(brightest.size() - 1));
  std::nth_element(brightest.begin(), place, brightest.end());
  return *place > 0 ? 0.8 / static_cast<double>(*place) : 1;
}

Bytes false_colour_difference(const Image& reference, const Image& model, double exposure, double gain) {
  if (reference.width != model.width || reference.height != model.height) {
    throw std::invalid_argument("false_colour_difference: the pictures must have one size");
  }
  Bytes bytes{reference.width, reference.height, {}};
  bytes.rgb.reserve(reference.rgb.size());
  for (std::size_t n = 0; n < reference.rgb.size(); n += 3) {
    double difference = 0;
    for (std::size_t c = n; c < n + 3; ++c) {
      difference += std::abs(srgb_encode(exposure * reference.rgb[c]) - srgb_encode(exposure * model.rgb[c])) / 3;
    }
    const Colour colour = plot::viridis(gain * difference);
    for (const double value : {colour.red, colour.green, colour.blue}) {
      bytes.rgb.push_back(static_cast<std::uint8_t>(std::lround(255 * value)));
    }
  }
  return bytes;
}

void write_sphere_figure(const std::filesystem::path& path, const std::string& title,
                         std::span<const SpherePair> columns) {
  ImageGrid grid;
  grid.title = title;
  grid.row_labels = {"reference", "model", "difference \u00d7 5"};
  grid.rows.resize(3);
  for (const SpherePair& pair : columns) {
    const double exposure = display_exposure(*pair.reference);
    const ImageErrors errors = image_errors(*pair.reference, *pair.model, exposure);
    grid.column_labels.push_back(pair.label);
    grid.rows[0].push_back({to_srgb(*pair.reference, exposure), ""});
    grid.rows[1].push_back({to_srgb(*pair.model, exposure),
                            "PSNR " + fixed(errors.psnr_gamma_db, 1) + " dB, SSIM " + fixed(errors.ssim, 3)});
    grid.rows[2].push_back({false_colour_difference(*pair.reference, *pair.model, exposure, kGain),
                            "mean \u0394E_{00} " + fixed(errors.delta_e_2000, 2)});
  }
  grid.colour_bar = Axis{.label = "absolute difference of displayed values", .low = 0, .high = 1 / kGain};
  plot::write_grid(path, grid);
}

void write_margin_figure(const std::filesystem::path& path, const std::string& title, const View& reference,
                         std::span<const View> models) {
  const Axis probability{.label = "probability per bin"};
  LinePlot theta_h{.title = "half angle", .x = theta_h_axis(), .y = probability};
  LinePlot theta_d{
      .title = "difference angle", .x = degrees("\u03b8_{d}", 90, {0, 15, 30, 45, 60, 75, 90}), .y = probability};
  LinePlot phi_d{
      .title = "difference azimuth", .x = degrees("\u03c6_{d}", 180, {0, 45, 90, 135, 180}), .y = probability};
  std::size_t index = 0;
  for (const View* view : reference_and(reference, models)) {
    const CellShares share = cell_shares(view->cells[kGreen]);
    theta_h.lines.push_back(margin(*view, index, share.theta_h, Grid::theta_h_centre));
    theta_d.lines.push_back(margin(*view, index, share.theta_d, Grid::theta_d_centre));
    phi_d.lines.push_back(margin(*view, index, share.phi_d, Grid::phi_d_centre));
    ++index;
  }
  plot::write_page(path, {.title = title + ": margins, green", .panels = {theta_h, theta_d, phi_d}});
}

void write_joint_figure(const std::filesystem::path& path, const std::string& title, const View& reference,
                        std::span<const View> models) {
  Page page{.title = title + ": joint density, green"};
  double highest = 0;
  for (const View* view : reference_and(reference, models)) {
    HeatMap map{.title = view->name, .x = degrees("\u03b8_{d}", 90, {0, 15, 30, 45, 60, 75, 90}), .y = theta_h_axis()};
    for (int n = 0; n <= 90; ++n) {
      map.x_edges.push_back(n);
      map.y_edges.push_back(n * n / 90.0);
    }
    map.values = cell_shares(view->cells[kGreen]).joint;
    highest = std::max(highest, map.values.maxCoeff());
    page.panels.push_back(std::move(map));
  }
  for (Panel& panel : page.panels) {  // one scale for all
    auto& map = std::get<HeatMap>(panel);
    map.colour = {.label = "probability per bin", .scale = Scale::logarithmic};
    if (highest > 0) {
      map.colour.high = highest;
      map.colour.low = highest * std::pow(10, -kDecades);
    }
  }
  plot::write_page(path, page);
}

void write_albedo_figure(const std::filesystem::path& path, const std::string& title, const View& reference,
                         std::span<const View> models) {
  const std::vector<const View*> views = reference_and(reference, models);
  double highest = 0;
  for (const View* view : views) highest = std::max(highest, view->albedo.albedo.maxCoeff());
  Axis albedo = plot::fitted({}, {0, highest});
  albedo.label = "directional albedo";
  constexpr std::array<const char*, 3> kNames{"red", "green", "blue"};
  Page page{.title = title + ": albedo"};
  for (int c = 0; c < 3; ++c) {
    LinePlot plot{.title = kNames[static_cast<std::size_t>(c)],
                  .x = degrees("\u03b8_{o}", 90, {0, 15, 30, 45, 60, 75, 90}),
                  .y = albedo};
    for (std::size_t n = 0; n < views.size(); ++n) {
      Line line = styled(views[n]->name, n);
      const AlbedoCurve& curve = views[n]->albedo;
      for (Eigen::Index row = 0; row < curve.theta_o.size(); ++row) {
        line.x.push_back(curve.theta_o(row) / kDegree);
        line.y.push_back(curve.albedo(row, c));
      }
      plot.lines.push_back(std::move(line));
    }
    page.panels.push_back(std::move(plot));
  }
  plot::write_page(path, page);
}

std::vector<std::filesystem::path> write_figures(const std::filesystem::path& folder, const std::string& name,
                                                 const std::string& title, const View& reference,
                                                 std::span<const View> models) {
  std::vector<std::filesystem::path> paths;
  for (const char* kind : {"spheres", "margins", "joint", "albedo"}) {
    paths.push_back(folder / (name + "_" + kind + ".png"));
  }
  std::vector<SpherePair> columns;
  for (const View& model : models) columns.push_back({model.name, &reference.sphere, &model.sphere});
  write_sphere_figure(paths[0], title, columns);
  write_margin_figure(paths[1], title, reference, models);
  write_joint_figure(paths[2], title, reference, models);
  write_albedo_figure(paths[3], title, reference, models);
  return paths;
}

}  // namespace sklar::brdf
