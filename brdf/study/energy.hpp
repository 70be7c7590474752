#pragma once
/// Models that send back no more light than they get.

#include <memory>

#include "brdf/model/anisotropic_model.hpp"
#include "brdf/model/refined_brdf.hpp"

namespace sklar::brdf {

/// A model and what was done to it.
template <class Model>
struct Limited {
  std::shared_ptr<const Model> brdf;  ///< the model itself where it kept the limit
  double albedo_before = 0;           ///< largest directional albedo over wo and channels
  double albedo_after = 0;            ///<
  double lowest_factor = 1;           ///< the least by which values were multiplied, at some theta_d
};

/// Lowers a model where its directional albedo exceeds a limit: all components are multiplied by one smooth factor of
/// theta_d, at most 1, found by repeated projection onto the worst wo, so that as little as possible changes elsewhere.
/// The albedo is taken at theta_o of 0, 0.5, .., 89.5 degrees; of an anisotropic model at 0, 3, .., 87 degrees and
/// phi_o of 0, 15, .., 345. Reciprocity is not touched.
/// @param limit positive.
/// @throws std::invalid_argument for another limit; std::runtime_error if the limit is not reached.
[[nodiscard]] Limited<RefinedBrdf> limit_albedo(const std::shared_ptr<const RefinedBrdf>& model, double limit = 1);
[[nodiscard]] Limited<AnisotropicModel> limit_albedo(const std::shared_ptr<const AnisotropicModel>& model,
                                                     double limit = 1);

/// The same for any reflectance and channel by channel: f_r is multiplied by k(theta_i) k(theta_o), at most 1. k is 1
/// where the albedo keeps the limit, and lowered by turns elsewhere; it is found at 0, 1, .., 89 degrees, of an
/// anisotropic reflectance from the largest albedo over phi_o of 0, 15, .., 345, and linear between them.
[[nodiscard]] Limited<Brdf> limit_albedo(const BrdfPtr& brdf, double limit = 1);

}  // namespace sklar::brdf
