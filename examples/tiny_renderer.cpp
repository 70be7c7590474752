// A path tracer of a sphere of any Brdf on a grey floor, by a thread a row and with no allocation per ray:
//     tiny_renderer [OUT.png [MODEL.sklar]]

#include <cmath>
#include <cstdio>
#include <thread>
#include <vector>

#include "brdf/analytic/lambert.hpp"
#include "brdf/analytic/synthetic.hpp"
#include "brdf/geometry/frame.hpp"
#include "brdf/model/model_io.hpp"
#include "brdf/model/refined_fit.hpp"
#include "brdf/render/image.hpp"
#include "brdf/sampling/sampled_brdf.hpp"
#include "copula/random.hpp"

using namespace sklar::brdf;

Rgb sky(const Vec3& direction) {
  return Rgb(0.5, 0.7, 1) * (0.5 + 0.5 * direction.y()) + 4 * std::exp(30 * (direction.dot(Vec3(-0.5, 0.7, 0.5)) - 1));
}

// The unit sphere around the origin, the floor y = -1.
Rgb radiance(const Brdf& sphere, const Brdf& floor, Vec3 origin, Vec3 direction, sklar::Rng& rng) {
  Rgb weight = Rgb::Ones();
  for (int reflections = 0; reflections <= 5; ++reflections) {
    const double b = origin.dot(direction), root = b * b - origin.squaredNorm() + 1;
    const double to_sphere = root > 0 ? -b - std::sqrt(root) : 0, to_floor = -(origin.y() + 1) / direction.y();
    const bool on_sphere = to_sphere > 1e-6;
    if (!on_sphere && !(to_floor > 1e-6)) return weight * sky(direction);
    origin += (on_sphere ? to_sphere : to_floor) * direction;
    const Frame frame(on_sphere ? origin.normalized() : Vec3::UnitY());
    const Sample drawn =
        (on_sphere ? sphere : floor).sample(frame.to_local(-direction), {sklar::uniform(rng), sklar::uniform(rng)});
    weight *= drawn.weight;  // f_r cos(theta_i) / pdf
    direction = frame.to_world(drawn.wi);
  }
  return Rgb::Zero();
}

void render(const Brdf& sphere, Image& image, int paths) {
  const Lambert floor(Rgb(0.4, 0.4, 0.4));
  std::vector<std::jthread> rows(static_cast<std::size_t>(image.height));
  for (int row = 0; row < image.height; ++row) {
    rows[static_cast<std::size_t>(row)] = std::jthread([&, row] {
      sklar::Rng rng(static_cast<std::uint64_t>(row));
      for (int path = 0; path < image.width * paths; ++path) {
        const int column = path / paths;
        const double x = (column + sklar::uniform(rng) - image.width / 2.0) / image.height;
        const double y = (image.height / 2.0 - row - sklar::uniform(rng)) / image.height;
        const Rgb light = radiance(sphere, floor, Vec3(0, 0.3, 4), Vec3(x, y - 0.075, -1).normalized(), rng);
        for (int c = 0; c < 3; ++c) image.at(row, column, c) += static_cast<float>(light[c] / paths);
      }
    });
  }
}

int main(int argc, char** argv) {
  const auto fitted = [] { return fit_refined(builtin_material(), {.evaluations = 60}).brdf; };
  const SampledBrdf sphere(argc > 2 ? read_brdf(argv[2]).brdf() : fitted());
  Image image(96, 64);
  render(sphere, image, 64);
  if (argc > 1) write_png(argv[1], image);
  std::printf("sphere of %zu bytes, middle of the picture %.3f\n", sphere.brdf()->bytes(), image.at(32, 48, 1));
}
