#pragma once
/// Distributions whose Laplace transform is a generator psi(t) = E e^(-t V): U_i = psi(E_i / V) with exponential E_i
/// has the Archimedean copula of psi (Marshall and Olkin 1988, JASA 83, 834). All return log V, as V leaves the range
/// of double at strong dependence.

#include "copula/random.hpp"

namespace sklar::frailty {

/// Standard exponential.
[[nodiscard]] double exponential(Rng& rng);

/// Gamma(shape, scale 1), shape > 0. Marsaglia and Tsang (2000), ACM TOMS 26, 363.
[[nodiscard]] double log_gamma(Rng& rng, double shape);

/// Positive stable with Laplace transform exp(-t^alpha), 0 < alpha <= 1. Kanter (1975), Ann. Probab. 3, 697.
[[nodiscard]] double log_positive_stable(Rng& rng, double alpha);

/// Logarithmic series, P(V = k) = p^k / (k h), p = 1 - e^-h, h > 0. Kemp (1981), Applied Statistics 30, 249 (LK).
[[nodiscard]] double log_logarithmic(Rng& rng, double h);

/// Sibuya, P(V > k) = prod_{j<=k} (1 - alpha/j), 0 < alpha <= 1: geometric with a Beta(alpha, 1 - alpha) probability.
/// Devroye (1993), Statist. Probab. Lett. 18, 349.
[[nodiscard]] double log_sibuya(Rng& rng, double alpha);

/// Geometric on 1, 2, ..: P(V = k) = (1 - q) q^(k-1), 0 <= q < 1.
[[nodiscard]] double log_geometric(Rng& rng, double q);

}  // namespace sklar::frailty
