/// The coordinates and terms of the anisotropic model for rows side by side; included once for each instruction set.
///
/// Everything is algebraic in the components of the half vector h, of d = (wi - wo) / 2 and of the two directions, and
/// bounded by 1. What has no meaning where h or a direction is the normal, or wi = wo, is damped to 0 there.

#if defined(SKLAR_BRDF_MODEL_ANISOTROPIC_TERMS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKLAR_BRDF_MODEL_ANISOTROPIC_TERMS_INL_H_
#undef SKLAR_BRDF_MODEL_ANISOTROPIC_TERMS_INL_H_
#else
#define SKLAR_BRDF_MODEL_ANISOTROPIC_TERMS_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "brdf/model/anisotropic_kernel.hpp"
#include "brdf/model/spline.hpp"
#include "brdf/model/warp.hpp"

HWY_BEFORE_NAMESPACE();
namespace sklar::brdf::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using PointTag = hn::CappedTag<float, kPointBlock>;
constexpr std::ptrdiff_t kPointLanes = static_cast<std::ptrdiff_t>(hn::MaxLanes(PointTag()));
constexpr int kMostTerms = 128, kMostPolynomials = 7;

/// Rows side by side.
struct F {
  hn::Vec<PointTag> v;

  F() = default;
  HWY_INLINE F(hn::Vec<PointTag> value) : v(value) {}
  HWY_INLINE F(float value) : v(hn::Set(PointTag(), value)) {}
};
HWY_INLINE F operator+(F a, F b) {
  return hn::Add(a.v, b.v);
}
HWY_INLINE F operator-(F a, F b) {
  return hn::Sub(a.v, b.v);
}
HWY_INLINE F operator*(F a, F b) {
  return hn::Mul(a.v, b.v);
}
HWY_INLINE F operator/(F a, F b) {
  return hn::Div(a.v, b.v);
}
HWY_INLINE F sqrt(F a) {
  return hn::Sqrt(a.v);
}
HWY_INLINE F load(const float* from) {
  return hn::LoadU(PointTag(), from);
}
HWY_INLINE void store(F a, float* to) {
  hn::StoreU(a.v, PointTag(), to);
}

/// Pairs of directions. Which one is called wi is settled by their components, so that what follows is the same to the
/// last bit for (wo, wi) and (wi, wo).
struct Pairs {
  F wi[3], wo[3], h[3], d[3];
  F square;  ///< |wi + wo|^2

  HWY_INLINE void load_rows(const DirectionRows& o, const DirectionRows& i, std::ptrdiff_t row, std::ptrdiff_t last) {
    HWY_ALIGN float numbers[13][kPointBlock];
    for (std::ptrdiff_t lane = 0; lane < kPointLanes; ++lane) {
      const std::ptrdiff_t from = std::min(row + lane, last);
      double a[3], b[3], sum[3];
      for (std::ptrdiff_t k = 0; k < 3; ++k) {
        a[k] = i.first[k * i.stride + from];
        b[k] = o.first[k * o.stride + from];
      }
      const bool swapped = std::tie(a[2], a[0], a[1]) < std::tie(b[2], b[0], b[1]);
      double longest = 0;
      for (int k = 0; k < 3; ++k) {
        sum[k] = a[k] + b[k];
        longest = std::max(longest, std::abs(sum[k]));
        const double less = (a[k] - b[k]) / 2;
        numbers[k][lane] = static_cast<float>(swapped ? b[k] : a[k]);
        numbers[3 + k][lane] = static_cast<float>(swapped ? a[k] : b[k]);
        numbers[9 + k][lane] = static_cast<float>(swapped ? -less : less);
      }
      double square_sum = 0;  // of the scaled sum, which neither overflows nor vanishes
      for (double& x : sum) {
        x /= longest;
        square_sum += x * x;
      }
      const double length = std::sqrt(square_sum);
      for (int k = 0; k < 3; ++k) numbers[6 + k][lane] = static_cast<float>(sum[k] / length);
      numbers[12][lane] = static_cast<float>(square_sum * longest * longest);
    }
    for (int k = 0; k < 3; ++k) {
      wi[k] = load(numbers[k]);
      wo[k] = load(numbers[3 + k]);
      h[k] = load(numbers[6 + k]);
      d[k] = load(numbers[9 + k]);
    }
    square = load(numbers[12]);
  }

  [[nodiscard]] HWY_INLINE F sin2_d() const { return d[0] * d[0] + d[1] * d[1] + d[2] * d[2]; }

  /// As Warped::difference.
  [[nodiscard]] HWY_INLINE F difference() const {
    const F left = F(0.25F) * square / (F(1.0F) + sqrt(sin2_d()));
    return hn::Max(hn::Zero(PointTag()), (F(1.0F) - sqrt(left)).v);
  }
};

/// The half coordinate s / (1 + s), s^4 = q / h_z^2, of a squared distance q from the axis; h_z > 0.
HWY_INLINE F half_coordinate(F q, F h_z) {
  const F s = sqrt(sqrt(q));
  return s / (s + sqrt(h_z));
}

/// The distance of h from the axis of a component and what its derivatives are made of.
struct Distance {
  F x, y, q;

  Distance() = default;
  HWY_INLINE Distance(const float* metric, const F* h)
      : x(h[0] - F(metric[3]) * h[2]), y(h[1] - F(metric[4]) * h[2]), q() {
    constexpr float kRound = 1e-6F;  // of h_z^2: no cusp at the axis
    q = F(metric[0]) * x * x + F(2 * metric[1]) * x * y + F(metric[2]) * y * y + F(kRound) * h[2] * h[2];
  }
};

/// Weights of the coefficients first .. first + 3 of a uniform cubic spline, and their derivatives by x.
struct Spline {
  hn::Vec<hn::RebindToSigned<PointTag>> first;
  F weight[kSplineOrder];

  HWY_INLINE F locate(F x, int count) {
    const PointTag d;
    const hn::RebindToSigned<PointTag> di;
    const int intervals = count - kSplineOrder + 1;
    const F position = x * F(static_cast<float>(intervals));
    // Also for NaN, which rows below the horizon may have.
    first = hn::Max(hn::Zero(di), hn::Min(hn::ConvertTo(di, position.v), hn::Set(di, intervals - 1)));
    const F t = position - F(hn::ConvertTo(d, first)), s = F(1.0F) - t, sixth(1.0F / 6);
    weight[0] = sixth * s * s * s;
    weight[1] = sixth * (t * t * (F(3.0F) * t - F(6.0F)) + F(4.0F));
    weight[2] = sixth * (s * s * (F(3.0F) * s - F(6.0F)) + F(4.0F));
    weight[3] = sixth * t * t * t;
    return t;
  }
};

/// Bernstein polynomials 0 to degree. @return their number.
HWY_INLINE int bernstein(F x, int degree, F* out) {
  const F y = F(1.0F) - x;
  out[0] = F(1.0F);
  for (int n = 1; n <= degree; ++n) {
    out[n] = x * out[n - 1];
    for (int i = n - 1; i >= 1; --i) out[i] = x * out[i - 1] + y * out[i];
    out[0] = y * out[0];
  }
  return degree + 1;
}

/// Appends all products to `out`. @return the end.
HWY_INLINE F* products(const F* a, int count_a, const F* b, int count_b, F* out) {
  for (int i = 0; i < count_a; ++i) {
    for (int j = 0; j < count_b; ++j) *out++ = a[i] * b[j];
  }
  return out;
}

/// Masking and shadowing: the mean of functions of one direction each.
HWY_INLINE F* masking_terms(const AnisotropicStructure& s, const Pairs& pairs, F* out) {
  constexpr float kKnee = 0.2F;  // of the cosine, below which the polynomials are finest
  F* to = out;
  for (const F* w : {pairs.wi, pairs.wo}) {
    F polynomials[kMostPolynomials], harmonics[5];
    const int count = bernstein(w[2] * F(1 + kKnee) / (w[2] + F(kKnee)), s.masking, polynomials);
    harmonics[0] = F(0.5F);
    harmonics[1] = F(0.5F) * (w[0] * w[0] - w[1] * w[1]);
    harmonics[2] = w[0] * w[1];
    harmonics[3] = F(2.0F) * (harmonics[1] * harmonics[1] - harmonics[2] * harmonics[2]);
    harmonics[4] = F(4.0F) * harmonics[1] * harmonics[2];
    to = out;
    for (int m = 0; m <= 2 * s.masking_harmonics; ++m) {
      for (int n = 0; n < (m == 0 ? count - 1 : count); ++n, ++to) {  // all polynomials sum to 1
        const F term = harmonics[m] * polynomials[n];
        *to = w == pairs.wi ? term : *to + term;
      }
    }
  }
  return to;
}

/// @param shared, colours room for kMostTerms each.
HWY_INLINE void find_terms(const AnisotropicStructure& s, const Pairs& pairs, F* shared, F* colours) {
  constexpr float kScale = 30;        // of the round metric
  constexpr float kAxisPole = 1e-3F;  // added to sin^2 theta_h under the harmonics of phi_h
  const F* h = pairs.h;
  const F* d = pairs.d;
  const F sin2_h = h[0] * h[0] + h[1] * h[1];
  const F difference = pairs.difference(), half = half_coordinate(F(kScale) * sin2_h, h[2]);
  const F reach = sin2_h * pairs.sin2_d() + F(static_cast<float>(kPole));
  F along[kMostPolynomials], across[kMostPolynomials];

  F* out = shared;
  const int azimuths = bernstein(d[2] * d[2] / reach, s.azimuth, across);
  const int differences = bernstein(difference, s.azimuth_difference, along);
  out = products(across + 1, azimuths - 1, along, differences, out);
  out = masking_terms(s, pairs, out);

  F harmonics[4];
  harmonics[0] = (h[0] * h[0] - h[1] * h[1]) / (sin2_h + F(kAxisPole));
  harmonics[1] = F(2.0F) * h[0] * h[1] / (sin2_h + F(kAxisPole));
  harmonics[2] = harmonics[0] * harmonics[0] - harmonics[1] * harmonics[1];
  harmonics[3] = F(2.0F) * harmonics[0] * harmonics[1];
  const int halves = bernstein(half, s.half_harmonics_degree, across);
  products(harmonics, 2 * s.half_harmonics, across, halves, out);
  const int colour_halves = bernstein(half, s.colour_half, across);
  const int colour_differences = bernstein(difference, s.colour_difference, along);
  products(across, colour_halves, along, colour_differences, colours);
}

}  // namespace sklar::brdf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
