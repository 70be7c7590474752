#pragma once
/// Light from all around, as a picture of the whole sphere that can be drawn from.

#include <memory>

#include "brdf/render/environment.hpp"
#include "brdf/render/image.hpp"

namespace sklar::brdf {

/// A latitude-longitude map: the top row is +y, the middle column -z, and x grows to the right. Radiance is constant
/// over a pixel, and draws follow its luminance exactly.
class EnvironmentMap {
 public:
  /// @throws std::invalid_argument for a value that is negative or not finite, or a picture without pixels.
  explicit EnvironmentMap(Image map);

  /// The same radiance from everywhere. @throws as above.
  [[nodiscard]] static EnvironmentMap constant(const Rgb& radiance);

  /// The environment at the centres of 2 rows x rows pixels. @throws as above; also unless rows is at least 1.
  [[nodiscard]] static EnvironmentMap tabulated(const Environment& environment, int rows = 512);

  /// A direction drawn from the map.
  struct Draw {
    Vec3 direction;
    Rgb radiance;
    double pdf;  ///< per solid angle
  };

  /// @param direction unit.
  [[nodiscard]] Rgb radiance(const Vec3& direction) const;

  /// Density per solid angle of draw; 0 everywhere if the map is black.
  [[nodiscard]] double pdf(const Vec3& direction) const;

  /// One direction from two uniforms in (0,1). Precondition: power() > 0.
  [[nodiscard]] Draw draw(const Vec2& uniforms) const;

  /// The integral of luminance over the sphere.
  [[nodiscard]] double power() const { return rows_.back(); }

 private:
  struct Pixel {
    int row;
    int column;
  };
  [[nodiscard]] Pixel pixel(const Vec3& direction) const;
  [[nodiscard]] Rgb value(const Pixel& pixel) const;
  [[nodiscard]] double density(const Rgb& radiance) const;

  Image map_;
  std::vector<double> rows_;     ///< running sum over rows of luminance times solid angle
  std::vector<double> columns_;  ///< in each row, running sum of luminance
};

/// How maps are held and shared.
using EnvironmentPtr = std::shared_ptr<const EnvironmentMap>;

}  // namespace sklar::brdf
