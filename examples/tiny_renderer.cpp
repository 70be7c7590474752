// A path tracer of a sphere of any Brdf on a grey floor, by several threads and with no allocation per ray:
//     tiny_renderer [OUT.png [MODEL.sklar]]

#include <array>
#include <cmath>
#include <cstdio>
#include <thread>

#include "brdf/analytic/lambert.hpp"
#include "brdf/analytic/synthetic.hpp"
#include "brdf/geometry/frame.hpp"
#include "brdf/model/model_io.hpp"
#include "brdf/model/refined_fit.hpp"
#include "brdf/render/image.hpp"
#include "brdf/sampling/sampled_brdf.hpp"
#include "copula/random.hpp"

using namespace sklar::brdf;

struct Hit {
  double distance;
  Vec3 normal;
  const Brdf* material;  // none where the ray leaves the scene
};

// The unit sphere around the origin, the floor y = -1.
Hit nearest(const Brdf& sphere, const Brdf& floor, const Vec3& origin, const Vec3& direction) {
  const double b = origin.dot(direction), root = b * b - origin.squaredNorm() + 1;
  const double distance = root > 0 ? -b - std::sqrt(root) : 0;
  if (distance > 1e-6) return {distance, origin + distance * direction, &sphere};
  const double below = direction.y() < 0 ? -(origin.y() + 1) / direction.y() : 0;
  if (below > 1e-6) return {below, Vec3(0, 1, 0), &floor};
  return {0, Vec3::Zero(), nullptr};
}

Rgb sky(const Vec3& direction) {
  static const Vec3 lamp = Vec3(-0.5, 0.7, 0.5).normalized();
  return Rgb(0.5, 0.7, 1) * (0.5 + 0.5 * direction.y()) + 4 * std::exp(30 * (direction.dot(lamp) - 1));
}

Rgb radiance(const Brdf& sphere, const Brdf& floor, Vec3 origin, Vec3 direction, sklar::Rng& rng) {
  Rgb weight = Rgb::Ones();
  for (int reflections = 0; reflections <= 5; ++reflections) {
    const Hit hit = nearest(sphere, floor, origin, direction);
    if (hit.material == nullptr) return weight * sky(direction);
    const Frame frame(hit.normal.normalized());
    const Sample drawn = hit.material->sample(frame.to_local(-direction), {sklar::uniform(rng), sklar::uniform(rng)});
    weight *= drawn.weight;  // f_r cos(theta_i) / pdf
    origin += hit.distance * direction;
    direction = frame.to_world(drawn.wi);
  }
  return Rgb::Zero();
}

void render(const Brdf& sphere, Image& image) {
  constexpr int kPaths = 64, kThreads = 4;
  const Lambert floor(Rgb(0.4, 0.4, 0.4));
  const auto draw = [&](int first) {
    for (int row = first; row < image.height; row += kThreads) {
      sklar::Rng rng(static_cast<std::uint64_t>(row));
      for (int path = 0; path < image.width * kPaths; ++path) {
        const int column = path / kPaths;
        const double x = (column + sklar::uniform(rng) - image.width / 2.0) / image.height;
        const double y = (image.height / 2.0 - row - sklar::uniform(rng)) / image.height;
        const Rgb light = radiance(sphere, floor, Vec3(0, 0.3, 4), Vec3(x, y - 0.075, -1).normalized(), rng);
        for (int c = 0; c < 3; ++c) image.at(row, column, c) += static_cast<float>(light[c] / kPaths);
      }
    }
  };
  std::array<std::jthread, kThreads> threads;  // waited for at the end
  for (int t = 0; t < kThreads; ++t) threads[static_cast<std::size_t>(t)] = std::jthread(draw, t);
}

int main(int argc, char** argv) {
  const RefinedFitOptions quick{.structure = {.components = 2, .half = 12, .difference = 8}, .evaluations = 60};
  const SampledBrdf sphere(argc > 2 ? read_brdf(argv[2]).brdf() : fit_refined(builtin_material(), quick).brdf);
  Image image(96, 64);
  render(sphere, image);
  if (argc > 1) write_png(argv[1], image);
  std::printf("sphere of %zu bytes, middle of the picture %.3f\n", sphere.brdf()->bytes(), image.at(32, 48, 1));
}
