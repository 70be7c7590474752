#pragma once
/// What plots that judge a fitted copula show beside the data.

#include "copula/copula.hpp"

namespace sklar {

/// For each row the share of the other rows that are nowhere above it, #{j != i: x_j <= x_i in every column} / (n-1):
/// estimates of C(u_i). Genest and Boies, Amer. Statist. 57 (2003) 275, H_i. O(n log^2 n) for two columns, else O(d
/// n^2).
/// @param x n x d, n, d >= 2, finite. @return n values in [0,1].
/// @throws std::invalid_argument (shape), std::domain_error naming a value that is not finite.
[[nodiscard]] Column joint_ranks(const PointsRef& x);

/// The expectation of the i-th smallest of n products of d independent uniforms: where the i-th smallest of joint_ranks
/// is expected when all coordinates are independent. With K_0(w) = w sum_{k<d} (-log w)^k / k! and its density k_0,
///   n binom(n-1, i-1) int_0^1 w k_0(w) K_0(w)^(i-1) (1 - K_0(w))^(n-i) dw.
/// Genest and Boies, Amer. Statist. 57 (2003) 275, W_{i:n} for d = 2. Relative error below 1e-10.
/// @param i 1 to n. @param dim d >= 1. @throws std::invalid_argument
[[nodiscard]] double expected_joint_rank(Index i, Index n, int dim);

/// Kendall distribution K(t) = P(C(U) <= t): exact for an ArchimedeanCopula, for any other one the share among
/// kKendallDraws points that are always the same ones, with a standard error of at most 0.0036.
/// @param t n values in [0,1]. @throws std::domain_error for another t.
[[nodiscard]] Column kendall_distribution(const Copula& copula, const ColumnRef& t);

/// See kendall_distribution.
inline constexpr Index kKendallDraws = 20'000;

/// The normal quantile of every entry. @param u n x d strictly in (0,1). @throws std::domain_error
[[nodiscard]] Points normal_scores(const PointsRef& u);

/// sum_k q(h(u_1..u_k))^2 with the normal quantile q: the squared length of the normal scores of the Rosenblatt
/// transform, chi-square with d degrees of freedom where the copula is right and u are its points. Breymann, Dias and
/// Embrechts, Quant. Finance 3 (2003) 1, sec. 4. It depends on the order of the columns.
/// @param u n x d strictly in (0,1). @throws std::invalid_argument, std::domain_error
[[nodiscard]] Column squared_normal_scores(const Copula& copula, const PointsRef& u);

/// The x below which a chi-square variable is with probability p. @param p in [0,1). @param degrees >= 1. @throws
/// std::domain_error
[[nodiscard]] double chi_square_quantile(double p, int degrees);

}  // namespace sklar
