#include "brdf/sampling/sampled_brdf.hpp"

#include <stdexcept>

namespace sklar::brdf {
namespace {

const Brdf& require(const BrdfPtr& brdf) {
  if (!brdf) throw std::invalid_argument("SampledBrdf: no reflectance given");
  return *brdf;
}

}  // namespace

SampledBrdf::SampledBrdf(BrdfPtr brdf) : brdf_(std::move(brdf)), sampler_(require(brdf_)) {}

void SampledBrdf::eval_batch(const DirectionsRef& wo, const DirectionsRef& wi, Eigen::Ref<RgbRows> out) const {
  out = brdf_->eval(wo, wi);
}

}  // namespace sklar::brdf
