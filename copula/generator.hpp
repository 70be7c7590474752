#pragma once
/// What a family provides: the generator psi and its derivatives of any order, in logarithms.

#include <concepts>
#include <span>

#include "copula/random.hpp"
#include "copula/wide.hpp"

namespace sklar {

/// psi decreases from psi(0) = 1 to psi(inf) = 0 and is d-monotone in the dimension it is used in (McNeil and Neslehova
/// 2009). Every member is a template over T = Narrow, Extended or Widest (copula/wide.hpp), so that one formula serves
/// all:
///   log_psi(t)           log psi(t), t >= 0
///   psi_inv(u)           t with psi(t) = u, for a double u in (0,1)
///   log_abs_dpsi(k, t)   log |psi^(k)(t)|, k >= 0
/// t itself is safe in T: where it leaves the range of double, the row is repeated in a wider type.
template <class G>
concept Generator = requires(const G& g, const Narrow& t, const Widest& wide_t, double u, int k) {
  { g.log_psi(t) } -> std::same_as<Narrow>;
  { g.log_psi(wide_t) } -> std::same_as<Widest>;
  { g.template psi_inv<Narrow>(u) } -> std::same_as<Narrow>;
  { g.log_abs_dpsi(k, t) } -> std::same_as<Narrow>;
  { g.log_abs_dpsi(k, wide_t) } -> std::same_as<Widest>;
};

/// Optional: log density of the points u (d values in [0,1]) in fused, cancellation-free form.
template <class G>
concept HasLogDensity = requires(const G& g, std::span<const double> u) {
  { g.template log_density<Narrow>(u) } -> std::same_as<Narrow>;
};

/// Optional: log C(u) of d values in (0,1], without t, which may leave the range of every type.
template <class G>
concept HasLogCdf = requires(const G& g, std::span<const double> u) {
  { g.template log_cdf<Narrow>(u) } -> std::same_as<Narrow>;
};

/// Optional: log h(u_1..u_k), k >= 2, given values in [0,1], the last in (0,1), accurate in the relative sense also
/// where h is near 1.
template <class G>
concept HasLogConditional = requires(const G& g, std::span<const double> u) {
  { g.template log_conditional<Narrow>(u) } -> std::same_as<Narrow>;
};

/// Optional: -log v for the v with h(given.., v) = p, p in (0,1), at least one value in [0,1] given, accurate in the
/// relative sense.
template <class G>
concept HasConditionalInverse = requires(const G& g, std::span<const double> given, double p) {
  { g.template conditional_inverse<Narrow>(given, p) } -> std::same_as<Narrow>;
};

/// Optional: log of the frailty, whose Laplace transform is psi, and whether there is one for these parameters.
template <class G>
concept HasFrailty = requires(const G& g, Rng& rng) {
  { g.has_frailty() } -> std::same_as<bool>;
  { g.log_frailty(rng) } -> std::same_as<double>;
};

}  // namespace sklar
