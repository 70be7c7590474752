// The error of a refined model and its derivatives, azimuths side by side.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "brdf/model/refined_loss_simd.cpp"
#include "copula/instruction_sets.hpp"
//
#include <hwy/foreach_target.h>
//
#include <algorithm>
#include <cmath>

#include "brdf/model/refined_loss.hpp"
#include "brdf/model/refined_structure.hpp"
#include "copula/simd/math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sklar::brdf::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace sn = sklar::simd::HWY_NAMESPACE;
using D = hn::CappedTag<float, kLossColumns>;
using V = hn::Vec<D>;

constexpr float kLargestLog = 60, kFloor = 1e-3F, kTiny = 1e-12F;
constexpr float kRelativeSoftness = 4;  // times that of log1p

struct Term {
  V value, slope;
};

/// sqrt(x^2 + e^2) - e.
HWY_INLINE Term soft_absolute(V x, V e) {
  const V root = hn::Sqrt(hn::MulAdd(x, x, hn::Mul(e, e)));
  return {hn::Sub(root, e), hn::Div(x, root)};
}

/// |ln((g c + floor) / (f c + floor))| and its derivative by g.
HWY_INLINE Term log_ratio(V f, V g, V c, float floor, float softness) {
  const D d;
  const V to = hn::Set(d, floor), inverse = hn::Div(hn::Set(d, 1.0F), hn::MulAdd(g, c, to));
  const V log_ratio = hn::Neg(sn::log(d, hn::Mul(hn::MulAdd(f, c, to), inverse)));
  const Term soft = soft_absolute(log_ratio, hn::Set(d, softness));
  return {soft.value, hn::Mul(soft.slope, hn::Mul(c, inverse))};
}

HWY_INLINE V cube_root(V x) {
  const D d;
  return sn::exp(d, hn::Mul(hn::Set(d, 1.0F / 3), sn::log(d, hn::Add(x, hn::Set(d, kTiny)))));
}

HWY_INLINE Term cube_root_error(V f, V g, V c) {
  const D d;
  const V root = cube_root(hn::Mul(g, c)), miss = hn::Sub(root, cube_root(hn::Mul(f, c)));
  const V slope = hn::Div(hn::Mul(hn::Set(d, 2.0F / 3), hn::Mul(miss, c)), hn::Mul(root, root));
  return {hn::Mul(miss, miss), slope};
}

HWY_INLINE Term square_error(V f, V g, V c) {
  const V miss = hn::Mul(hn::Sub(g, f), c);
  return {hn::Mul(miss, miss), hn::Mul(hn::Set(D(), 2.0F), hn::Mul(miss, c))};
}

HWY_INLINE Term poisson_error(V f, V g, V w) {
  const D d;
  const V tiny = hn::Set(d, kTiny), ratio = hn::Div(hn::Add(f, tiny), hn::Add(g, tiny));
  const V value = hn::MulAdd(f, sn::log(d, ratio), hn::Sub(g, f));
  return {hn::Mul(w, value), hn::Mul(w, hn::Sub(hn::Set(d, 1.0F), hn::Div(f, hn::Add(g, tiny))))};
}

/// Sum of the weighted measures at some cells of one channel.
struct Total {
  V value, slope;

  HWY_INLINE void add(float weight, const Term& term) {
    const V w = hn::Set(D(), weight);
    value = hn::MulAdd(w, term.value, value);
    slope = hn::MulAdd(w, term.slope, slope);
  }
};

HWY_INLINE Total cell_error(const LossWeights& w, V f, V g, V cos_i, V cos_o) {
  const D d;
  Total total{hn::Zero(d), hn::Zero(d)};
  const V both = hn::Max(hn::Mul(cos_i, cos_o), hn::Set(d, kFloor));
  if (w.log1p > 0) {
    total.add(w.log1p / 2, log_ratio(f, g, cos_i, 1, w.softness));
    total.add(w.log1p / 2, log_ratio(f, g, cos_o, 1, w.softness));
  }
  if (w.log_relative > 0) total.add(w.log_relative, log_ratio(f, g, both, kFloor, kRelativeSoftness * w.softness));
  if (w.cube_root > 0) {
    total.add(w.cube_root / 2, cube_root_error(f, g, cos_i));
    total.add(w.cube_root / 2, cube_root_error(f, g, cos_o));
  }
  if (w.likelihood > 0) total.add(w.likelihood, poisson_error(f, g, both));
  if (w.image > 0) {
    total.add(w.image / 2, square_error(f, g, cos_i));
    total.add(w.image / 2, square_error(f, g, cos_o));
  }
  return total;
}

HWY_INLINE float sum(V x) {
  return hn::GetLane(hn::SumOfLanes(D(), x));
}

/// exp of what azimuth adds, by component.
HWY_INLINE void azimuth_factors(const LossModel& model, int row, V z, std::ptrdiff_t at, V* factor) {
  const D d;
  for (int k = 0; k < model.components; ++k) {
    const float* powers = model.powers.data() + k * model.degree;
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
      const std::ptrdiff_t cell = row * kLossColumns + at;
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
