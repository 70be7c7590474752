#include "brdf/render/path_tracer.hpp"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <stdexcept>

#include "brdf/luminance.hpp"
#include "brdf/render/lights.hpp"
#include "brdf/render/ray_scene.hpp"
#include "brdf/render/sample_points.hpp"

namespace sklar::brdf {
namespace {

constexpr int kSurePaths = 4;       ///< reflections before Russian roulette
constexpr double kSurvival = 0.95;  ///< its highest chance to go on

/// Weight of a strategy of density `own` beside one of density `other`.
double power_heuristic(double own, double other) {
  const double ratio = other / own;
  return 1 / (1 + ratio * ratio);
}

/// Local frame of a surface: x horizontal, z the normal.
class SurfaceFrame {
 public:
  explicit SurfaceFrame(const Vec3& normal) {
    const double across = std::hypot(normal.x(), normal.z());
    const Vec3 tangent = across > 0 ? Vec3(normal.z() / across, 0, -normal.x() / across) : Vec3(1, 0, 0);
    axes_ << tangent, normal.cross(tangent), normal;
  }
  [[nodiscard]] Vec3 to_local(const Vec3& world) const { return axes_.transpose() * world; }
  [[nodiscard]] Vec3 to_world(const Vec3& local) const { return axes_ * local; }

 private:
  Eigen::Matrix3d axes_;
};

/// Directions of view.
class View {
 public:
  explicit View(const Scene& scene) : width_(scene.width), height_(scene.height) {
    const Vec3 forward = (scene.camera.target - scene.camera.position).normalized();
    const Vec3 right = forward.cross(scene.camera.up).normalized();
    const double slope = std::tan(scene.camera.field_of_view * std::numbers::pi / 360);
    forward_ = forward;
    right_ = slope * scene.width / scene.height * right;
    up_ = slope * right.cross(forward);
  }

  /// @param x, y in pixels from the upper left.
  [[nodiscard]] Vec3 direction(double x, double y) const {
    return (forward_ + (2 * x / width_ - 1) * right_ + (1 - 2 * y / height_) * up_).normalized();
  }

 private:
  double width_, height_;
  Vec3 forward_, right_, up_;
};

/// The uniforms of one path. Three dimensions a reflection, after that of the pixel.
class PathPoints {
 public:
  PathPoints(const PixelPoints& points, int sample) : points_(points), sample_(static_cast<std::uint32_t>(sample)) {}

  [[nodiscard]] Vec2 pixel() const { return points_.at(sample_, 0); }
  [[nodiscard]] Vec2 surface(int bounce) const { return at(bounce, 0); }
  [[nodiscard]] Vec2 light(int bounce) const { return at(bounce, 1); }
  [[nodiscard]] Vec2 choices(int bounce) const { return at(bounce, 2); }

 private:
  [[nodiscard]] Vec2 at(int bounce, int which) const {
    return points_.at(sample_, static_cast<std::uint32_t>(1 + 3 * bounce + which));
  }

  const PixelPoints& points_;
  std::uint32_t sample_;
};

/// The slope of y^(1/2.2) at a displayed value y, bounded near black; above 1, where displays cut, a tenth.
double display_slope(double y) {
  constexpr double kDarkest = 1e-3, kCut = 0.1;
  return y > 1 ? kCut / 2.2 : std::pow(std::max(y, kDarkest), 1 / 2.2 - 1) / 2.2;
}

struct NoRecorder {
  void begin() const {}
  void arrive(const Rgb&) const {}
  void reflect_light(const Brdf&, const Vec3&, const Vec3&, const Rgb&) const {}
  void reflect_path(const Brdf&, const Vec3&, const Vec3&) const {}
};

/// The uses of one material. What arrives at a path came by way of all its reflections.
class UseRecorder {
 public:
  UseRecorder(const Brdf& material, std::vector<LightUse>& uses) : material_(material), uses_(uses) {}

  void begin() { on_path_.clear(); }
  void arrive(const Rgb& light) {
    for (const std::size_t use : on_path_) uses_[use].light += luminance(light);
  }
  void reflect_light(const Brdf& material, const Vec3& wo, const Vec3& wi, const Rgb& light) {
    if (&material == &material_) uses_.push_back({wo, wi, luminance(light)});
  }
  void reflect_path(const Brdf& material, const Vec3& wo, const Vec3& wi) {
    if (&material != &material_) return;
    on_path_.push_back(uses_.size());
    uses_.push_back({wo, wi, 0});
  }

 private:
  const Brdf& material_;
  std::vector<LightUse>& uses_;
  std::vector<std::size_t> on_path_;
};

class PathTracer {
 public:
  PathTracer(const Scene& scene, const PathOptions& options)
      : scene_(scene), options_(options), rays_(scene), lights_(scene, rays_.radius()), view_(scene) {}

  /// @param recorder told of every reflection of the paths and the light that they bring.
  template <class Recorder>
  [[nodiscard]] Rgb pixel(int row, int column, Recorder&& recorder) const {
    const PixelPoints points(options_.seed,
                             static_cast<std::uint64_t>(row) << 32U | static_cast<std::uint32_t>(column));
    Rgb sum = Rgb::Zero();
    for (int sample = 0; sample < options_.samples; ++sample) {
      const PathPoints path(points, sample);
      const Vec2 place = path.pixel();
      recorder.begin();
      sum += radiance(view_.direction(column + place.x(), row + place.y()), path, recorder);
    }
    return sum / options_.samples;
  }

 private:
  /// A path as far as it has come: a ray, and what light along it is worth to the camera.
  struct Path {
    Vec3 origin;
    Vec3 direction;
    Rgb throughput = Rgb::Ones();
    double pdf = 0;  ///< of the direction; 0 = the camera's
  };

  template <class Recorder>
  [[nodiscard]] Rgb radiance(const Vec3& direction, const PathPoints& points, Recorder& recorder) const {
    Path path{.origin = scene_.camera.position, .direction = direction};
    Rgb sum = Rgb::Zero();
    const auto gather = [&](const Rgb& light) {
      sum += path.throughput * light;
      recorder.arrive(path.throughput * light);
    };
    for (int bounce = 0;; ++bounce) {
      const std::optional<Hit> hit = rays_.closest(path.origin, path.direction);
      if (!hit) {
        gather(distant(path));
        return sum;
      }
      gather(emitted(path, *hit));
      const BrdfPtr& material = scene_.objects[hit->object].material;
      if (bounce == scene_.depth || !material || !(hit->face_normal.dot(path.direction) < 0)) return sum;
      const bool seen = hit->shading_normal.dot(path.direction) < 0;
      const SurfaceFrame frame(seen ? hit->shading_normal : hit->face_normal);
      const Vec3 wo = frame.to_local(-path.direction);
      const Vec2 choices = points.choices(bounce);
      if (options_.draw_lights) {
        const Lit light = lit(*hit, frame, *material, wo, choices.x(), points.light(bounce));
        gather(light.radiance);
        recorder.reflect_light(*material, wo, light.wi, path.throughput * light.radiance);
      }
      const Sample sample = material->sample(wo, points.surface(bounce));
      if (!extend(path, *hit, frame, sample)) return sum;
      recorder.reflect_path(*material, wo, sample.wi);
      if (bounce >= kSurePaths && !survives(path, choices.y())) return sum;
    }
  }

  /// Light that the path meets beyond all objects.
  [[nodiscard]] Rgb distant(const Path& path) const {
    if (path.pdf == 0 && scene_.background) return *scene_.background;
    if (!scene_.environment) return Rgb::Zero();
    return weight(path, path.pdf > 0 ? lights_.environment_pdf(path.direction) : 0) *
           scene_.environment->radiance(path.direction);
  }

  [[nodiscard]] Rgb emitted(const Path& path, const Hit& hit) const {
    const Rgb& emission = scene_.objects[hit.object].emission;
    if (!(emission.maxCoeff() > 0) || !(hit.face_normal.dot(path.direction) < 0)) return Rgb::Zero();
    return weight(path, path.pdf > 0 ? lights_.pdf(path.origin, path.direction, hit) : 0) * emission;
  }

  [[nodiscard]] double weight(const Path& path, double light_pdf) const {
    return path.pdf > 0 && options_.draw_lights ? power_heuristic(path.pdf, light_pdf) : 1.0;
  }

  struct Lit {
    Vec3 wi = Vec3::UnitZ();
    Rgb radiance = Rgb::Zero();
  };

  /// Light reflected toward wo from one draw of the lights.
  [[nodiscard]] Lit lit(const Hit& hit, const SurfaceFrame& frame, const Brdf& material, const Vec3& wo, double choice,
                        const Vec2& uniforms) const {
    const LightDraw light = lights_.draw(hit.point, choice, uniforms);
    if (!(light.pdf > 0) || !(hit.face_normal.dot(light.direction) > 0)) return {};
    const Vec3 wi = frame.to_local(light.direction);
    if (!(wi.z() > 0)) return {};
    const Rgb reflected = material.eval(wo, wi) * wi.z();
    if (!(reflected.maxCoeff() > 0) || blocked(hit, light)) return {};
    const double share = light.has_extent ? power_heuristic(light.pdf, material.pdf(wo, wi)) : 1.0;
    return {wi, reflected * light.radiance * (share / light.pdf)};
  }

  [[nodiscard]] bool blocked(const Hit& hit, const LightDraw& light) const {
    const Vec3 from = rays_.start(hit, light.direction);
    return std::isfinite(light.distance) ? rays_.blocked(from, hit.point + light.distance * light.direction)
                                         : rays_.blocked_toward(from, light.direction);
  }

  /// Goes on in the drawn direction. @return whether any light can come from there.
  [[nodiscard]] bool extend(Path& path, const Hit& hit, const SurfaceFrame& frame, const Sample& sample) const {
    if (!(sample.weight.maxCoeff() > 0)) return false;
    path.direction = frame.to_world(sample.wi).normalized();
    if (!(hit.face_normal.dot(path.direction) > 0)) return false;
    path.origin = rays_.start(hit, path.direction);
    path.throughput *= sample.weight;
    path.pdf = sample.pdf;
    return true;
  }

  /// Russian roulette.
  [[nodiscard]] static bool survives(Path& path, double uniform) {
    const double chance = std::min(path.throughput.maxCoeff(), kSurvival);
    path.throughput /= chance;
    return uniform < chance;
  }

  const Scene& scene_;
  const PathOptions& options_;
  RayScene rays_;
  Lights lights_;
  View view_;
};

void require_options(const Scene& scene, const PathOptions& options) {
  require_scene(scene);
  if (options.samples < 1) {
    throw std::invalid_argument("samples must be at least 1, got " + std::to_string(options.samples));
  }
}

constexpr int kTile = 16;  // pixels

int tiles_along(int pixels) {
  return (pixels + kTile - 1) / kTile;
}

std::size_t pixel_tiles(const Scene& scene) {
  return static_cast<std::size_t>(tiles_along(scene.width)) * static_cast<std::size_t>(tiles_along(scene.height));
}

/// Calls action(tile, row, column) for every pixel, tile by tile on all threads.
template <class Action>
void for_each_pixel(const Scene& scene, const Progress& progress, const Action& action) {
  const int across = tiles_along(scene.width), tiles = static_cast<int>(pixel_tiles(scene));
  ProgressCounter counter(progress, tiles);
  tbb::parallel_for(0, tiles, [&](int tile) {
    const int top = tile / across * kTile, left = tile % across * kTile;
    for (int row = top; row < std::min(top + kTile, scene.height); ++row) {
      for (int column = left; column < std::min(left + kTile, scene.width); ++column) action(tile, row, column);
    }
    counter.step();
  });
}

}  // namespace

Image render_paths(const Scene& scene, const PathOptions& options) {
  require_options(scene, options);
  const PathTracer tracer(scene, options);
  Image image(scene.width, scene.height);
  for_each_pixel(scene, options.progress, [&](int, int row, int column) {
    const Rgb colour = tracer.pixel(row, column, NoRecorder());
    for (int c = 0; c < 3; ++c) image.at(row, column, c) = static_cast<float>(colour(c));
  });
  return image;
}

std::vector<LightUse> light_uses(const Scene& scene, const Brdf& material, const PathOptions& options) {
  require_options(scene, options);
  const PathTracer tracer(scene, options);
  std::vector<std::vector<LightUse>> by_tile(pixel_tiles(scene));
  for_each_pixel(scene, options.progress, [&](int tile, int row, int column) {
    std::vector<LightUse>& uses = by_tile[static_cast<std::size_t>(tile)];
    const std::size_t first = uses.size();
    const Rgb colour = tracer.pixel(row, column, UseRecorder(material, uses));
    const double slope = display_slope(scene.exposure * luminance(colour));
    std::for_each(uses.begin() + static_cast<std::ptrdiff_t>(first), uses.end(),
                  [&](LightUse& use) { use.light *= scene.exposure * slope / options.samples; });
  });
  std::vector<LightUse> all;
  for (const std::vector<LightUse>& uses : by_tile) {
    std::copy_if(uses.begin(), uses.end(), std::back_inserter(all), [](const LightUse& use) { return use.light > 0; });
  }
  return all;
}

}  // namespace sklar::brdf
