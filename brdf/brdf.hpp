#pragma once
/// The interface of every reflectance model and measured table.
///
/// Directions are unit vectors in the local frame (z = surface normal) and point away from the surface. wo is given, wi
/// is sampled. eval is f_r in 1/sr without the cosine; pdf is per solid angle of wi; weight includes the cosine.

#include <Eigen/Core>
#include <memory>
#include <string>

namespace sklar::brdf {

/// Two uniforms, a direction, and a colour (red, green, blue).
using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Rgb = Eigen::Array3d;
using Directions = Eigen::ArrayX3d;                       ///< n x 3, unit rows
using DirectionsRef = Eigen::Ref<const Eigen::ArrayX3d>;  ///< read-only view
using RgbRows = Eigen::ArrayX3d;                          ///< n x 3, red green blue
using UniformsRef = Eigen::Ref<const Eigen::ArrayX2d>;    ///< n x 2, in (0,1)

/// What a model claims of itself; the conformance suite tests each claim.
struct Traits {
  bool reciprocal = true;     ///< eval(wo, wi) and eval(wi, wo) agree to the last bit
  bool isotropic = true;      ///< eval does not change when both directions turn about z
  bool non_negative = true;   ///< eval is nowhere below 0; series and truncated bases can be, and are not clamped
  double albedo_bound = 0.0;  ///< upper bound of the directional albedo, 0 = no claim
};

/// A direction drawn given wo.
struct Draw {
  Vec3 wi;
  double pdf;  ///< of wi given wo, per solid angle
};

/// A direction drawn given wo, with its weight.
struct Sample {
  Vec3 wi;
  double pdf;  ///< per solid angle
  Rgb weight;  ///< f_r cos(theta_i) / pdf; 0 for a draw below the horizon
};

/// A Sample a row.
struct Samples {
  Directions wi;
  Eigen::ArrayXd pdf;
  RgbRows weight;
};

/// Immutable and thread-safe; single calls do not allocate.
class Brdf {
 public:
  virtual ~Brdf() = default;

  /// f_r(wi, wo) in 1/sr per channel, 0 when either direction is below the horizon (z <= 0). Finite, never NaN; never
  /// negative where Traits::non_negative is claimed.
  [[nodiscard]] virtual Rgb eval(const Vec3& wo, const Vec3& wi) const = 0;

  /// Row by row the same numbers as the single call. @param wo, wi n x 3. @return n x 3.
  /// @throws std::invalid_argument if the row counts differ.
  template <typename Wo, typename Wi>
  [[nodiscard]] RgbRows eval(const Eigen::ArrayBase<Wo>& wo, const Eigen::ArrayBase<Wi>& wi) const {
    return eval_rows(wo.derived(), wi.derived());
  }

  /// Density per solid angle of wi given wo, as drawn by sample; 0 below the horizon. Default: cosine hemisphere.
  [[nodiscard]] virtual double pdf(const Vec3& wo, const Vec3& wi) const;

  /// One draw of wi given wo from two uniforms in (0,1). The weight f cos / pdf is computed here and nowhere else.
  [[nodiscard]] Sample sample(const Vec3& wo, const Vec2& uniforms) const;

  /// Row by row the same numbers as the single call. @param wo n x 3. @param uniforms n x 2.
  /// @throws std::invalid_argument if the row counts differ.
  template <typename Wo, typename Uniforms>
  [[nodiscard]] Samples sample(const Eigen::ArrayBase<Wo>& wo, const Eigen::ArrayBase<Uniforms>& uniforms) const {
    return sample_rows(wo.derived(), uniforms.derived());
  }

  /// What the model claims of itself.
  [[nodiscard]] virtual Traits traits() const = 0;

  /// Size in bytes of everything evaluation needs.
  [[nodiscard]] virtual std::size_t bytes() const = 0;

 protected:
  /// eval row by row. Precondition: equal row counts. Default: single calls.
  virtual void eval_batch(const DirectionsRef& wo, const DirectionsRef& wi, Eigen::Ref<RgbRows> out) const;

  /// The direction drawn by sample. Default: cosine hemisphere.
  [[nodiscard]] virtual Vec3 sample_direction(const Vec3& wo, const Vec2& uniforms) const;

  /// What sample needs of the sampler, for those that have the density of a draw cheaper than from its direction alone.
  /// Default: the two calls.
  [[nodiscard]] virtual Draw draw(const Vec3& wo, const Vec2& uniforms) const;

  /// The same row by row, into wi and pdf of `out`.
  virtual void draw_batch(const DirectionsRef& wo, const UniformsRef& uniforms, Samples& out) const;

 private:
  [[nodiscard]] RgbRows eval_rows(const DirectionsRef& wo, const DirectionsRef& wi) const;
  [[nodiscard]] Samples sample_rows(const DirectionsRef& wo, const UniformsRef& uniforms) const;
};

/// How reflectances are held and shared.
using BrdfPtr = std::shared_ptr<const Brdf>;

}  // namespace sklar::brdf
