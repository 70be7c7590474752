#include "brdf/sampling/conditional_sampler.hpp"

#include "brdf/sampling/sampler_fit.hpp"

namespace sklar::brdf {

ConditionalSampler::ConditionalSampler(const Brdf& brdf) : tables_(fit_sampler(brdf, kCosineShare)) {}

}  // namespace sklar::brdf
