#pragma once
/// The routes that need nothing but psi, psi^-1 and the derivatives: what a family without closed forms uses, and what
/// the closed forms of the others are tested against. They cancel at extremes; the error bound of T sees it. McNeil and
/// Neslehova (2009), Annals of Statistics 37(5), Theorem 2 and its Corollary 2; docs/conventions.md.

#include <span>

#include "copula/generator.hpp"
#include "copula/numerics.hpp"

namespace sklar {

/// t = sum psi^-1(u_i).
template <class T, Generator G>
[[nodiscard]] T generic_sum(const G& g, std::span<const T> u) {
  T t(0.0);
  for (const T& value : u) {
    if (!is_one(value)) t += g.psi_inv(value);
  }
  return t;
}

/// psi^-1(u) and log |psi'| there.
template <class T, Generator G>
[[nodiscard]] std::pair<T, T> generic_margin(const G& g, const T& u) {
  if constexpr (HasMargin<G>) {
    return g.margin(u);
  } else {
    const T t = is_one(u) ? T(0.0) : g.psi_inv(u);
    return {t, g.log_abs_dpsi(1, t)};
  }
}

/// log c(u) = log |psi^(d)(t)| - sum log |psi'(psi^-1(u_i))|.
template <class T, Generator G>
[[nodiscard]] T generic_log_density(const G& g, std::span<const T> u) {
  T t(0.0), log_slopes(0.0);
  for (const T& value : u) {
    const auto [part, log_slope] = generic_margin(g, value);
    t += part;
    log_slopes += log_slope;
  }
  return g.log_abs_dpsi(static_cast<int>(u.size()), t) - log_slopes;
}

/// log h = log |psi^(j)(t_k)| - log |psi^(j)(t_j)|, j = k - 1 values given.
template <class T, Generator G>
[[nodiscard]] T generic_log_conditional(const G& g, std::span<const T> u) {
  const int given = static_cast<int>(u.size()) - 1;
  const T before = generic_sum(g, u.first(u.size() - 1));
  return g.log_abs_dpsi(given, before + g.psi_inv(u.back())) - g.log_abs_dpsi(given, before);
}

/// -log v with h(given.., v) = p: Newton for s = psi^-1(v) > 0 on log |psi^(j)(t_j)| - log |psi^(j)(t_j + s)| = -log p.
template <class T, Generator G>
[[nodiscard]] T generic_conditional_inverse(const G& g, std::span<const T> given, const T& p) {
  const int order = static_cast<int>(given.size());
  const T before = generic_sum(g, given);
  const T at_start = g.log_abs_dpsi(order, before);
  const auto rate = [&](const T& s) {
    const T here = g.log_abs_dpsi(order, before + s);
    return std::pair<T, T>(at_start - here, exp(g.log_abs_dpsi(order + 1, before + s) - here));
  };
  const T target = -log(p);
  const T slope = exp(g.log_abs_dpsi(order + 1, before) - at_start);
  const T guess = target / slope;
  using std::isfinite;
  const bool usable = guess.value > 0 && isfinite(guess.value);
  return -g.log_psi(solve_increasing(rate, target, usable ? guess : T(1.0)));
}

}  // namespace sklar
