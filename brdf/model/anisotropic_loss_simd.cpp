// The error of an anisotropic model and its derivatives, cells side by side.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "brdf/model/anisotropic_loss_simd.cpp"
#include "copula/instruction_sets.hpp"
//
#include <hwy/foreach_target.h>
//
#include "brdf/model/anisotropic_loss.hpp"
#include "brdf/model/anisotropic_terms-inl.h"
#include "brdf/model/cell_error-inl.h"
#include "copula/simd/math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sklar::brdf::HWY_NAMESPACE {

constexpr float kHighestLog = 60;
constexpr std::size_t kMost = kMostAnisotropicComponents;

HWY_INLINE F exp_of(F x) {
  return sn::exp(D(), hn::Min(x.v, hn::Set(D(), kHighestLog)));
}

/// A component at some cells.
struct Part {
  Distance distance;
  Spline spline;
  F slope;     ///< of the log density by the squared distance
  F value[3];  ///< red, green, blue

  HWY_INLINE void evaluate(const AnisotropicTables& m, std::ptrdiff_t k, const F* h, const F* shared,
                           const F* colours) {
    const D d;
    const int half = m.structure.half;
    distance = Distance(m.metric.data() + 5 * k, h);
    const F x = half_coordinate(distance.q, h[2]);
    const F t = spline.locate(x, half), t2 = t * t;
    const F rise[kSplineOrder] = {F(t) - F(0.5F) - F(0.5F) * t2, F(1.5F) * t2 - F(2.0F) * t, F(0.5F) + t - F(1.5F) * t2,
                                  F(0.5F) * t2};
    F green(0.0F), by_position(0.0F);
    for (int i = 0; i < kSplineOrder; ++i) {
      const F c = hn::GatherIndex(d, m.shape.data() + k * half + i, spline.first);
      green = green + spline.weight[i] * c;
      by_position = by_position + rise[i] * c;
    }
    slope = by_position * F(static_cast<float>(half - kSplineOrder + 1)) * x * (F(1.0F) - x) / (F(4.0F) * distance.q);
    F red(0.0F), blue(0.0F);
    for (int n = 0; n < m.shared; ++n) green = green + F(m.terms[k * m.shared + n]) * shared[n];
    for (int n = 0; n < m.colours; ++n) {
      red = red + F(m.red[k * m.colours + n]) * colours[n];
      blue = blue + F(m.blue[k * m.colours + n]) * colours[n];
    }
    value[0] = exp_of(green + red);
    value[1] = exp_of(green);
    value[2] = exp_of(green + blue);
  }
};

/// Second derivative of the error by log g.
HWY_INLINE F bend(const LossWeights& w, F f, F g, F cos_i, F cos_o) {
  const D d;
  const auto of_log = [&](F c, float floor, float softness) {
    const F to(floor), over = F(1.0F) / (g * c + to), share = g * c * over;
    const F miss = sn::log(d, ((f * c + to) * over).v);
    return share * share / sqrt(miss * miss + F(softness * softness));
  };
  const F both = hn::Max((cos_i * cos_o).v, hn::Set(d, kFloor));
  F total(0.0F);
  if (w.log1p > 0) total = total + F(w.log1p / 2) * (of_log(cos_i, 1, w.softness) + of_log(cos_o, 1, w.softness));
  if (w.log_relative > 0) total = total + F(w.log_relative) * of_log(both, kFloor, kRelativeSoftness * w.softness);
  if (w.cube_root > 0) {
    const F root = cube_root((g * F(0.5F) * (cos_i + cos_o)).v);
    total = total + F(w.cube_root * 2 / 9) * root * root;
  }
  if (w.likelihood > 0) total = total + F(w.likelihood) * g * both;
  if (w.image > 0) total = total + F(w.image) * g * g * (cos_i * cos_i + cos_o * cos_o);
  return total;
}

/// Adds to `sums` what the derivative by the log densities of a component at some cells makes of its numbers; for
/// curvatures the squares of the derivatives of the log density count.
template <bool kCurvature>
struct Collector {
  const AnisotropicTables& model;
  F terms[kMost][kMostTerms], red[kMost][kMostTerms], blue[kMost][kMostTerms], metric[kMost][5];

  HWY_INLINE explicit Collector(const AnisotropicTables& m) : model(m) {
    for (std::size_t k = 0; k < static_cast<std::size_t>(m.structure.components); ++k) {
      for (F& x : terms[k]) x = F(0.0F);
      for (F& x : red[k]) x = F(0.0F);
      for (F& x : blue[k]) x = F(0.0F);
      for (F& x : metric[k]) x = F(0.0F);
    }
  }

  static HWY_INLINE void add(F& sum, F by, F factor) { sum = sum + (kCurvature ? by * factor * factor : by * factor); }

  HWY_INLINE void add(std::ptrdiff_t k, const Part& part, const F* by, const F* h, const F* shared, const F* colours,
                      float* shape) {
    const F all = by[0] + by[1] + by[2];
    for (int n = 0; n < model.shared; ++n) add(terms[k][n], all, shared[n]);
    for (int n = 0; n < model.colours; ++n) {
      add(red[k][n], by[0], colours[n]);
      add(blue[k][n], by[2], colours[n]);
    }
    const float* m = model.metric.data() + 5 * k;
    const F x = part.distance.x, y = part.distance.y;
    const F outward = F(-2.0F) * h[2] * part.slope;
    add(metric[k][0], all, part.slope * x * x);
    add(metric[k][1], all, part.slope * F(2.0F) * x * y);
    add(metric[k][2], all, part.slope * y * y);
    add(metric[k][3], all, outward * (F(m[0]) * x + F(m[1]) * y));
    add(metric[k][4], all, outward * (F(m[1]) * x + F(m[2]) * y));
    HWY_ALIGN float weights[kSplineOrder][kPointBlock];
    HWY_ALIGN int first[kPointBlock];
    hn::StoreU(part.spline.first, hn::RebindToSigned<D>(), first);
    for (int i = 0; i < kSplineOrder; ++i) {
      const F w = part.spline.weight[i];
      store(kCurvature ? all * w * w : all * w, weights[i]);
    }
    for (std::ptrdiff_t lane = 0; lane < kPointLanes; ++lane) {
      for (int i = 0; i < kSplineOrder; ++i) shape[first[lane] + i] += weights[i][lane];
    }
  }

  HWY_INLINE void finish(AnisotropicSums& sums) const {
    const auto put = [](const F* from, int count, std::ptrdiff_t k, std::vector<float>& to) {
      for (int n = 0; n < count; ++n) to[static_cast<std::size_t>(k * count + n)] = sum(from[n].v);
    };
    for (std::ptrdiff_t k = 0; k < model.structure.components; ++k) {
      put(terms[k], model.shared, k, sums.terms);
      put(red[k], model.colours, k, sums.red);
      put(blue[k], model.colours, k, sums.blue);
      put(metric[k], 5, k, sums.metric);
    }
  }
};

template <bool kCurvature>
double collect(const LossWeights& weights, const AnisotropicSlice& slice, const AnisotropicTables& model,
               AnisotropicSums& sums) {
  const D d;
  Collector<kCurvature> collector(model);
  const int half = model.structure.half, components = model.structure.components;
  double loss = 0;
  const auto count = static_cast<std::ptrdiff_t>(slice.weight.size());
  for (std::ptrdiff_t cell = 0; cell < count; cell += kPointLanes) {
    const F weight = load(slice.weight.data() + cell);
    if (hn::AllTrue(d, hn::Eq(weight.v, hn::Zero(d)))) continue;
    const float* from =
        slice.points.values.data() + cell / kPointBlock * slice.points.numbers * kPointBlock + cell % kPointBlock;
    F numbers[3 + 2 * kMostTerms];
    for (std::ptrdiff_t n = 0; n < slice.points.numbers; ++n) numbers[n] = load(from + n * kPointBlock);
    const F* shared = numbers + 3;
    const F* colours = shared + model.shared;
    Part parts[kMost];
    F g[3] = {0.0F, 0.0F, 0.0F}, by_g[3];
    for (std::ptrdiff_t k = 0; k < components; ++k) {
      parts[k].evaluate(model, k, numbers, shared, colours);
      for (int c = 0; c < 3; ++c) g[c] = g[c] + parts[k].value[c];
    }
    const F cos_i = load(slice.cos_i.data() + cell), cos_o = load(slice.cos_o.data() + cell);
    F losses(0.0F);
    for (int c = 0; c < 3; ++c) {
      const F f = load(slice.measured[c].data() + cell);
      if constexpr (kCurvature) {
        by_g[c] = weight * bend(weights, f, g[c], cos_i, cos_o) / (g[c] * g[c] + F(kTiny * kTiny));
      } else {
        const Total total = cell_error(weights, f.v, g[c].v, cos_i.v, cos_o.v);
        losses = losses + weight * F(total.value);
        by_g[c] = weight * F(total.slope);
      }
    }
    loss += static_cast<double>(sum(losses.v));
    for (std::ptrdiff_t k = 0; k < components; ++k) {
      F by[3];
      for (int c = 0; c < 3; ++c) {
        const F value = parts[k].value[c];
        by[c] = by_g[c] * value;
        if (kCurvature) by[c] = by[c] * value;
      }
      collector.add(k, parts[k], by, numbers, shared, colours, sums.shape.data() + k * half);
    }
  }
  collector.finish(sums);
  return loss;
}

double loss(const LossWeights& weights, const AnisotropicSlice& slice, const AnisotropicTables& model,
            AnisotropicSums& sums) {
  return collect<false>(weights, slice, model, sums);
}

double curvature(const LossWeights& weights, const AnisotropicSlice& slice, const AnisotropicTables& model,
                 AnisotropicSums& sums) {
  return collect<true>(weights, slice, model, sums);
}

}  // namespace sklar::brdf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sklar::brdf {
namespace {
HWY_EXPORT(loss);
HWY_EXPORT(curvature);
}  // namespace

AnisotropicSums::AnisotropicSums(const AnisotropicTables& model)
    : shape(static_cast<std::size_t>(model.structure.components * model.structure.half)),
      terms(model.terms.size()),
      red(model.red.size()),
      blue(model.blue.size()),
      metric(model.metric.size()) {}

double anisotropic_loss(const LossWeights& weights, const AnisotropicSlice& slice, const AnisotropicTables& model,
                        AnisotropicSums& slopes) {
  slopes = AnisotropicSums(model);
  return HWY_DYNAMIC_DISPATCH(loss)(weights, slice, model, slopes);
}

AnisotropicSums anisotropic_curvature(const LossWeights& weights, const AnisotropicSlice& slice,
                                      const AnisotropicTables& model) {
  AnisotropicSums sums(model);
  (void)HWY_DYNAMIC_DISPATCH(curvature)(weights, slice, model, sums);
  return sums;
}

}  // namespace sklar::brdf
#endif
