#include "brdf/data/rgl_writer.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <stdexcept>
#include <vector>

#include "brdf/data/bilinear.hpp"
#include "brdf/data/colour.hpp"
#include "brdf/data/tensor_file.hpp"
#include "brdf/geometry/coordinates.hpp"
#include "brdf/geometry/frame.hpp"

namespace sklar::brdf {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr ImageBlend kOnly{{0, 0, 0}};
constexpr double kHorizon = 89.9 * kPi / 180;  // of what has a limit at the horizon and no value, the value here
constexpr double kLeastCosine = 1e-4;          // of the warp: a row of it without mass has no inverse
constexpr double kEverywhere = 0.01;           // the constant share of ndf
constexpr double kFacets = 0.3;                // the share of vndf that is D max(0, wi.m), of light everywhere
constexpr double kSpacing = 1.5;               // slices lie closer toward the horizon, where reflectance changes most

/// Position of node k of n in the unit interval.
double unit_node(int k, int n) {
  return static_cast<double>(k) / (n - 1);
}

double theta_of(double u) {
  return u * u * kPi / 2;
}
double phi_of(double u) {
  return (2 * u - 1) * kPi;
}
Vec3 direction_of(const Vec2& u) {
  return spherical_direction(theta_of(u.x()), phi_of(u.y()));
}

/// The luminance by which readers draw.
double file_luminance(const Rgb& rgb) {
  return 0.212671 * rgb[0] + 0.715160 * rgb[1] + 0.072169 * rgb[2];
}

/// The mean luminance of f_r over the pairs above the horizon with this half vector, by cos_i cos_o 4 cos(theta_d) dwd.
/// @param theta_h less than pi/2.
double mean_luminance(const Brdf& brdf, double theta_h, double phi_h) {
  constexpr int kPolar = 12, kAzimuth = 12;
  double sum = 0, weight = 0;
  for (int k = 0; k < kAzimuth; ++k) {
    const double phi_d = (k + 0.5) / kAzimuth * kPi;
    const double horizon = std::atan2(std::cos(theta_h), std::sin(theta_h) * std::abs(std::cos(phi_d)));
    for (int j = 0; j < kPolar; ++j) {
      const double theta_d = (j + 0.5) / kPolar * horizon;
      const auto [wi, wo] = directions4({theta_h, phi_h, theta_d, phi_d});
      const double share = wi.z() * wo.z() * std::cos(theta_d) * std::sin(theta_d) * horizon;
      sum += share * file_luminance(brdf.eval(wo, wi).max(0.0));
      weight += share;
    }
  }
  return sum / weight;
}

/// D and sigma over the unit square.
struct Normals {
  int rows, columns;  ///< two equal rows if isotropic
  std::vector<float> ndf, sigma;

  [[nodiscard]] BilinearStack stack(const std::vector<float>& values) const { return {1, rows, columns, values}; }
};

/// D dm at the midpoints of a grid over the hemisphere.
struct Facets {
  std::vector<Vec3> normal;
  std::vector<double> area;

  explicit Facets(const Normals& normals) {
    const int polar = normals.rows == 2 ? 512 : 256, azimuths = 64;
    const BilinearStack ndf = normals.stack(normals.ndf);
    for (int x = 0; x < polar; ++x) {
      for (int y = 0; y < azimuths; ++y) {
        const Vec2 u((x + 0.5) / polar, (y + 0.5) / azimuths);
        const double measure = std::sin(theta_of(u.x())) * (kPi * u.x() / polar) * (2 * kPi / azimuths);
        normal.push_back(direction_of(u));
        area.push_back(ndf.at(u, kOnly) * measure);
      }
    }
  }

  /// The area that a direction sees.
  [[nodiscard]] double seen_from(const Vec3& w) const {
    double sum = 0;
    for (std::size_t n = 0; n < area.size(); ++n) sum += area[n] * std::max(w.dot(normal[n]), 0.0);
    return sum;
  }
};

Normals normals_of(const Brdf& brdf, bool isotropic, const RglLayout& layout) {
  Normals normals{isotropic ? 2 : layout.warp_rows, layout.warp_columns, {}, {}};
  const auto fill = [&](std::vector<float>& values, const auto& value) {
    values.resize(static_cast<std::size_t>(normals.rows) * normals.columns);
    tbb::parallel_for(0, normals.columns, [&](int x) {
      float found = 0;
      for (int y = 0; y < normals.rows; ++y) {
        if (y == 0 || !isotropic) {
          found = static_cast<float>(value(Vec2(unit_node(x, normals.columns), unit_node(y, normals.rows))));
        }
        values[static_cast<std::size_t>(y * normals.columns + x)] = found;
      }
    });
  };
  fill(normals.ndf, [&](const Vec2& u) {
    const double theta = std::min(theta_of(u.x()), kHorizon);
    return mean_luminance(brdf, theta, phi_of(u.y())) * std::cos(theta);
  });
  const double total = Facets(normals).seen_from(Vec3::UnitZ());
  for (float& value : normals.ndf) {
    const double share = total > 0 ? (1 - kEverywhere) * static_cast<double>(value) / total : 0.0;
    value = static_cast<float>(share + kEverywhere / kPi);
  }
  const Facets facets(normals);
  const double level = facets.seen_from(Vec3::UnitZ());
  fill(normals.sigma, [&](const Vec2& u) { return facets.seen_from(direction_of(u)) / level; });
  return normals;
}

/// What a file holds of one known direction.
struct SliceImages {
  std::span<float> vndf, luminance, rgb;
};

class Writer {
 public:
  Writer(const Brdf& brdf, bool isotropic, const RglLayout& layout)
      : brdf_(brdf),
        layout_(layout),
        normals_(normals_of(brdf, isotropic, layout)),
        ndf_(normals_.stack(normals_.ndf)),
        sigma_(normals_.stack(normals_.sigma)) {
    const int azimuths = isotropic ? 1 : layout.azimuths;
    for (int p = 0; p < azimuths; ++p) {
      phi_i_.push_back(isotropic ? 0.0F : static_cast<float>(phi_of(unit_node(p, azimuths))));
    }
    for (int t = 0; t < layout.slices; ++t) {
      theta_i_.push_back(static_cast<float>(kPi / 2 * (1 - std::pow(1 - unit_node(t, layout.slices), kSpacing))));
    }
    const std::size_t slices = phi_i_.size() * theta_i_.size();
    vndf_.resize(slices * warp_nodes());
    luminance_.resize(slices * value_nodes());
    rgb_.resize(slices * 3 * value_nodes());
    tbb::parallel_for(std::size_t{0}, slices, [&](std::size_t slice) {
      const auto part = [slice](std::vector<float>& all, std::size_t size) {
        return std::span(all).subspan(slice * size, size);
      };
      fill(static_cast<double>(theta_i_[slice % theta_i_.size()]), static_cast<double>(phi_i_[slice / theta_i_.size()]),
           {part(vndf_, warp_nodes()), part(luminance_, value_nodes()), part(rgb_, 3 * value_nodes())});
    });
  }

  [[nodiscard]] std::vector<TensorField> fields(const RglWriteOptions& options) const {
    const std::size_t P = phi_i_.size(), T = theta_i_.size();
    const auto R = static_cast<std::size_t>(normals_.rows), W = static_cast<std::size_t>(normals_.columns);
    const auto H = static_cast<std::size_t>(layout_.warp_rows), n = static_cast<std::size_t>(layout_.nodes);
    const std::string& text = options.description;
    std::vector<TensorField> fields = {
        {"description", {text.size()}, std::vector<std::uint8_t>(text.begin(), text.end())},
        {"phi_i", {P}, phi_i_},
        {"theta_i", {T}, theta_i_},
        {"sigma", {R, W}, normals_.sigma},
        {"ndf", {R, W}, normals_.ndf},
        {"vndf", {P, T, H, W}, vndf_},
        {"luminance", {P, T, n, n}, luminance_}};
    if (options.form == RglForm::rgb) {
      fields.push_back({"rgb", {P, T, 3, n, n}, rgb_});
    } else {
      const std::vector<double> wavelengths = written_wavelengths();
      fields.push_back(
          {"wavelengths", {wavelengths.size()}, std::vector<float>(wavelengths.begin(), wavelengths.end())});
      fields.push_back({"spectra", {P, T, wavelengths.size(), n, n}, spectra()});
    }
    fields.push_back({"jacobian", {1}, std::vector<std::uint8_t>{1}});
    return fields;
  }

 private:
  [[nodiscard]] std::size_t warp_nodes() const {
    return static_cast<std::size_t>(layout_.warp_rows) * static_cast<std::size_t>(layout_.warp_columns);
  }
  [[nodiscard]] std::size_t value_nodes() const {
    return static_cast<std::size_t>(layout_.nodes) * static_cast<std::size_t>(layout_.nodes);
  }

  void fill(double theta_i, double phi_i, const SliceImages& images) const {
    const Known known{spherical_direction(theta_i, phi_i), spherical_direction(std::min(theta_i, kHorizon), phi_i)};
    const Shares shares = fill_vndf(known, images.vndf);
    const double area = 4 * sigma_.at({std::sqrt(2 * theta_i / kPi), (phi_i + kPi) / (2 * kPi)}, kOnly);
    fill_values(known, area, shares, images);
  }

  /// The known direction, and where it is on the horizon one just above it.
  struct Known {
    Vec3 wi, raised;
  };

  /// vndf is facets times D plus light times the luminance of f_r cos(theta_o), by what dwo counts in the unit square.
  struct Shares {
    double facets, light;
  };

  /// f_r cos(theta_o) mirrored at m; 0 below the horizon.
  [[nodiscard]] Rgb mirrored(const Known& known, const Vec3& m) const {
    const Vec3 wo = 2 * known.wi.dot(m) * m - known.wi;
    return wo.z() > 0 ? Rgb(brdf_.eval(wo, known.raised).max(0.0) * wo.z()) : Rgb(Rgb::Zero());
  }

  Shares fill_vndf(const Known& known, std::span<float> vndf) const {
    const int rows = layout_.warp_rows, columns = layout_.warp_columns;
    Eigen::ArrayXd light(vndf.size()), facets(vndf.size());
    for (Eigen::Index n = 0; n < light.size(); ++n) {
      const Vec2 u(unit_node(static_cast<int>(n) % columns, columns), unit_node(static_cast<int>(n) / columns, rows));
      const Vec3 m = direction_of(u);
      const double measure = std::max(known.wi.dot(m), kLeastCosine) * std::sin(theta_of(u.x())) * u.x();
      light[n] = measure * file_luminance(mirrored(known, m));
      facets[n] = measure * ndf_.at(u, kOnly);
    }
    const double all = light.sum();
    const Shares shares{(all > 0 ? kFacets : 1) / facets.sum(), all > 0 ? (1 - kFacets) / all : 0};
    Eigen::Map<Eigen::ArrayXf>(vndf.data(), light.size()) =
        (shares.facets * facets + shares.light * light).cast<float>();
    return shares;
  }

  /// @param area 4 sigma of the known direction.
  void fill_values(const Known& known, double area, const Shares& shares, const SliceImages& images) const {
    const BilinearWarp warp(1, layout_.warp_rows, layout_.warp_columns, images.vndf);
    const int n = layout_.nodes;
    for (int k = 0; k < n * n; ++k) {
      const Vec2 u = warp.sample({unit_node(k % n, n), unit_node(k / n, n)}, 0);
      const Rgb light = mirrored(known, direction_of(u)), value = light * (area / ndf_.at(u, kOnly));
      for (int c = 0; c < 3; ++c) images.rgb[static_cast<std::size_t>(c * n * n + k)] = static_cast<float>(value[c]);
      const double wanted = file_luminance(light), drawn = shares.facets * ndf_.at(u, kOnly) + shares.light * wanted;
      images.luminance[static_cast<std::size_t>(k)] = static_cast<float>(wanted / drawn);
    }
    const auto black = [](float value) { return value == 0; };
    if (std::all_of(images.luminance.begin(), images.luminance.end(), black)) {
      std::fill(images.luminance.begin(), images.luminance.end(), 1.0F);  // readers divide by its integral
    }
  }

  [[nodiscard]] std::vector<float> spectra() const {
    const std::vector<Rgb> primaries = primary_spectra();
    const std::size_t nodes = value_nodes();
    std::vector<float> spectra;
    spectra.reserve(rgb_.size() / 3 * primaries.size());
    for (std::size_t first = 0; first < rgb_.size(); first += 3 * nodes) {
      for (const Rgb& primary : primaries) {
        for (std::size_t k = first; k < first + nodes; ++k) {
          double value = 0;
          for (int c = 0; c < 3; ++c)
            value += primary[c] * static_cast<double>(rgb_[k + static_cast<std::size_t>(c) * nodes]);
          spectra.push_back(static_cast<float>(value));
        }
      }
    }
    return spectra;
  }

  const Brdf& brdf_;
  RglLayout layout_;
  Normals normals_;
  BilinearStack ndf_, sigma_;
  std::vector<float> phi_i_, theta_i_, vndf_, luminance_, rgb_;
};

void require(const RglLayout& layout, bool isotropic) {
  const auto at_least = [](const char* name, int found, int least) {
    if (found >= least) return;
    throw std::invalid_argument(std::string("write_rgl: ") + name + " is " + std::to_string(found) +
                                ", it must be at least " + std::to_string(least));
  };
  if (!isotropic) at_least("azimuths", layout.azimuths, 3);
  at_least("slices", layout.slices, 2);
  at_least("warp_rows", layout.warp_rows, 2);
  at_least("warp_columns", layout.warp_columns, 2);
  at_least("nodes", layout.nodes, 2);
}

}  // namespace

void write_rgl(const std::filesystem::path& path, const Brdf& brdf, const RglWriteOptions& options) {
  const bool isotropic = brdf.traits().isotropic;
  const RglLayout layout = options.layout.value_or(isotropic ? kIsotropicLayout : kAnisotropicLayout);
  require(layout, isotropic);
  write_tensor_file(path, Writer(brdf, isotropic, layout).fields(options));
}

}  // namespace sklar::brdf
