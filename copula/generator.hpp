#pragma once
/// What a family provides: the generator psi and its derivatives of any order, in logarithms.

#include <concepts>
#include <span>
#include <utility>

#include "copula/kernels.hpp"
#include "copula/random.hpp"
#include "copula/wide.hpp"

namespace sklar {

/// psi decreases from psi(0) = 1 to psi(inf) = 0 and is d-monotone in the dimension it is used in (McNeil and Neslehova
/// 2009). Every member is a template over T = Narrow, Extended or Widest (copula/wide.hpp), so that one formula serves
/// all:
///   log_psi(t)           log psi(t), t >= 0
///   psi_inv(u)           t with psi(t) = u, 0 < u < 1; u may have an error, at which it may be 1
///   log_abs_dpsi(k, t)   log |psi^(k)(t)|, k >= 0
/// t itself is safe in T: where it leaves the range of double, the row is repeated in a wider type.
///
/// A coordinate is a T too. That of a point is an exact double; a reflected one, 1 - u, has an error where T does not
/// hold it. It is on the boundary only where it is so exactly (is_zero, is_one): 1 with an error is a number near 1,
/// and where that is not enough to know, an answer has a large error and is repeated in a wider type.
template <class G>
concept Generator = requires(const G& g, const Narrow& t, const Widest& wide_t, int k) {
  { g.log_psi(t) } -> std::same_as<Narrow>;
  { g.log_psi(wide_t) } -> std::same_as<Widest>;
  { g.psi_inv(t) } -> std::same_as<Narrow>;
  { g.psi_inv(wide_t) } -> std::same_as<Widest>;
  { g.log_abs_dpsi(k, t) } -> std::same_as<Narrow>;
  { g.log_abs_dpsi(k, wide_t) } -> std::same_as<Widest>;
};

/// Optional: log density of the points u (d values in [0,1]) in fused, cancellation-free form.
template <class G>
concept HasLogDensity = requires(const G& g, std::span<const Narrow> u) {
  { g.log_density(u) } -> std::same_as<Narrow>;
};

/// Optional: log C(u) of d values in (0,1], without t, which may leave the range of every type.
template <class G>
concept HasLogCdf = requires(const G& g, std::span<const Narrow> u) {
  { g.log_cdf(u) } -> std::same_as<Narrow>;
};

/// Optional: log h(u_1..u_k), k >= 2, given values in [0,1], the last in (0,1), accurate in the relative sense also
/// where h is near 1.
template <class G>
concept HasLogConditional = requires(const G& g, std::span<const Narrow> u) {
  { g.log_conditional(u) } -> std::same_as<Narrow>;
};

/// Optional: -log v for the v with h(given.., v) = p, p in (0,1), at least one value in [0,1] given, accurate in the
/// relative sense.
template <class G>
concept HasConditionalInverse = requires(const G& g, std::span<const Narrow> given, const Narrow& p) {
  { g.conditional_inverse(given, p) } -> std::same_as<Narrow>;
};

/// Optional: psi^-1(u) and log |psi'| there, u in (0,1], for generators that remember what they were asked: the points
/// of a grid share few coordinates.
template <class G>
concept HasMargin = requires(const G& g, const Narrow& u) {
  { g.margin(u) } -> std::same_as<std::pair<Narrow, Narrow>>;
};

/// Optional: vector kernels of the copula of a dimension, or null where the parameters have none.
template <class G>
concept HasKernels = requires(const G& g, int dim) {
  { g.kernels(dim) } -> std::same_as<std::shared_ptr<const Kernels>>;
};

/// Optional: log of the frailty, whose Laplace transform is psi, and whether there is one for these parameters.
template <class G>
concept HasFrailty = requires(const G& g, Rng& rng) {
  { g.has_frailty() } -> std::same_as<bool>;
  { g.log_frailty(rng) } -> std::same_as<double>;
};

}  // namespace sklar
