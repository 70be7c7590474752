// The error of a refined model and its derivatives, azimuths side by side.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "brdf/model/refined_loss_simd.cpp"
#include "copula/instruction_sets.hpp"
//
#include <hwy/foreach_target.h>
//
#include <algorithm>
#include <cmath>

#include "brdf/model/cell_error-inl.h"
#include "brdf/model/refined_loss.hpp"
#include "brdf/model/refined_structure.hpp"
#include "copula/simd/math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sklar::brdf::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace sn = sklar::simd::HWY_NAMESPACE;
constexpr float kLargestLog = 60;

/// exp of what azimuth adds, by component.
HWY_INLINE void azimuth_factors(const LossModel& model, int row, V z, std::ptrdiff_t at, V* factor) {
  const D d;
  for (int k = 0; k < model.components; ++k) {
    const float* powers = model.powers.data() + static_cast<std::ptrdiff_t>(k) * model.degree;
    V log_factor = hn::Zero(d);
    for (int m = model.degree - 1; m >= 0; --m) log_factor = hn::Mul(hn::Add(log_factor, hn::Set(d, powers[m])), z);
    if (!model.coupling.empty()) {
      const auto first = (static_cast<std::ptrdiff_t>(k) * kLossRows + row) * kLossColumns + at;
      log_factor = hn::Add(log_factor, hn::LoadU(d, model.coupling.data() + first));
    }
    const V most = hn::Set(d, kLargestLog);
    factor[k] = sn::exp(d, hn::Min(hn::Max(log_factor, hn::Neg(most)), most));
  }
}

double slice_loss(const LossWeights& weights, const LossSlice& slice, const LossModel& model, LossModel& slopes) {
  const D d;
  const int degree = model.degree;
  double loss = 0;
  for (int row = 0; row < kLossRows; ++row) {
    float value[3][kMostComponents], by_value[3][kMostComponents] = {};
    for (int c = 0; c < 3; ++c) {
      for (int k = 0; k < model.components; ++k) {
        const float log_value = model.log_value[static_cast<std::size_t>((c * model.components + k) * kLossRows + row)];
        value[c][k] = std::exp(std::min(log_value, kLargestLog / 2));
      }
    }
    for (std::ptrdiff_t at = 0; at < kLossColumns; at += static_cast<std::ptrdiff_t>(hn::MaxLanes(d))) {
      const std::ptrdiff_t cell = std::ptrdiff_t{row} * kLossColumns + at;
      const V weight = hn::LoadU(d, slice.weight.data() + cell);
      if (hn::AllTrue(d, hn::Eq(weight, hn::Zero(d)))) continue;
      const V z = hn::LoadU(d, slice.azimuth.data() + cell);
      const V cos_i = hn::LoadU(d, slice.cos_i.data() + cell), cos_o = hn::LoadU(d, slice.cos_o.data() + cell);
      V factor[kMostComponents], by_factor[kMostComponents];
      azimuth_factors(model, row, z, at, factor);
      for (int k = 0; k < model.components; ++k) by_factor[k] = hn::Zero(d);
      V losses = hn::Zero(d);
      for (int c = 0; c < 3; ++c) {
        V g = hn::Zero(d);
        for (int k = 0; k < model.components; ++k) g = hn::MulAdd(hn::Set(d, value[c][k]), factor[k], g);
        const Total total = cell_error(weights, hn::LoadU(d, slice.measured[c].data() + cell), g, cos_i, cos_o);
        losses = hn::MulAdd(weight, total.value, losses);
        const V slope = hn::Mul(weight, total.slope);
        for (int k = 0; k < model.components; ++k) {
          const V part = hn::Mul(slope, hn::Mul(hn::Set(d, value[c][k]), factor[k]));
          by_value[c][k] += sum(part);
          by_factor[k] = hn::Add(by_factor[k], part);
        }
      }
      loss += static_cast<double>(sum(losses));
      for (int k = 0; k < model.components; ++k) {
        if (!model.coupling.empty()) {
          const auto first = (static_cast<std::ptrdiff_t>(k) * kLossRows + row) * kLossColumns + at;
          hn::StoreU(by_factor[k], d, slopes.coupling.data() + first);
        }
        V power = by_factor[k];
        for (int m = 0; m < degree; ++m) {
          power = hn::Mul(power, z);
          slopes.powers[static_cast<std::size_t>(k * degree + m)] += sum(power);
        }
      }
    }
    for (int c = 0; c < 3; ++c) {
      for (int k = 0; k < model.components; ++k) {
        slopes.log_value[static_cast<std::size_t>((c * model.components + k) * kLossRows + row)] = by_value[c][k];
      }
    }
  }
  return loss;
}

}  // namespace sklar::brdf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sklar::brdf {
namespace {
HWY_EXPORT(slice_loss);

std::vector<float> zeros() {
  return std::vector<float>(static_cast<std::size_t>(kLossRows) * kLossColumns);
}
}  // namespace

LossSlice::LossSlice()
    : measured{zeros(), zeros(), zeros()}, cos_i(zeros()), cos_o(zeros()), azimuth(zeros()), weight(zeros()) {}

double slice_loss(const LossWeights& weights, const LossSlice& slice, const LossModel& model, LossModel& slopes) {
  slopes = LossModel{.components = model.components,
                     .degree = model.degree,
                     .log_value = std::vector<float>(model.log_value.size()),
                     .powers = std::vector<float>(model.powers.size()),
                     .coupling = std::vector<float>(model.coupling.size())};
  return HWY_DYNAMIC_DISPATCH(slice_loss)(weights, slice, model, slopes);
}

}  // namespace sklar::brdf
#endif
