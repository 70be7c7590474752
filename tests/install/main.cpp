// A project outside this one that uses the installed package.
#include <iostream>

#include "brdf/brdf.hpp"
#include "families/registry.hpp"

namespace {

class White final : public sklar::brdf::Brdf {
 public:
  [[nodiscard]] sklar::brdf::Rgb eval(const sklar::brdf::Vec3&, const sklar::brdf::Vec3&) const override {
    return sklar::brdf::Rgb::Constant(0.25);
  }
  [[nodiscard]] sklar::brdf::Traits traits() const override { return {}; }
  [[nodiscard]] std::size_t bytes() const override { return sizeof *this; }
};

}  // namespace

int main() {
  const auto copula = sklar::families::find("independence").make(3, {});
  sklar::Points u(1, 3);
  u << 0.5, 0.5, 0.5;
  const double cdf = copula->cdf(u)(0);
  const sklar::brdf::Vec3 normal(0, 0, 1);
  const double weight = White().sample(normal, {0.25, 0.5}).weight(0) / (0.25 * 3.14159265358979);
  std::cout << "cdf " << cdf << ", weight / albedo " << weight << '\n';
  return cdf > 0.12 && cdf < 0.13 && weight > 0.99 && weight < 1.01 ? 0 : 1;
}
