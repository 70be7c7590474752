#pragma once
/// Spearman's rho of a copula.

#include "copula/family.hpp"

namespace sklar {

/// rho = 12 int int C(u,v) du dv - 3 of the first two coordinates, absolute error below 1e-10, by double exponential
/// quadrature over v < u, split at v = 1 - u and at the end of the support, where C bends. Takes about 2e4 values of C.
/// Precondition: exchangeable, as Archimedean copulas are. Nelsen (2006), eq. 5.1.15c.
[[nodiscard]] double spearman_rho(const Copula& copula);

/// The parameter whose pairs have this rho, the only one as families are ordered by concordance.
/// @throws std::invalid_argument for a family of more or fewer than one parameter, std::domain_error naming
/// the attainable end for rho beyond it, and for a family whose pairs differ.
[[nodiscard]] Theta theta_from_rho(const FamilyInfo& family, int dim, double rho);

/// The same for the lower or upper tail dependence coefficient. @throws as theta_from_rho.
[[nodiscard]] Theta theta_from_lower_tail(const FamilyInfo& family, int dim, double lambda);
[[nodiscard]] Theta theta_from_upper_tail(const FamilyInfo& family, int dim, double lambda);

}  // namespace sklar
