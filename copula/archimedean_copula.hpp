#pragma once
/// The Archimedean view of a copula: what C(u) = psi(sum psi^-1(u_i)) offers beyond Copula.

#include "copula/copula.hpp"

namespace sklar {

class ArchimedeanCopula : public Copula {
 public:
  /// log |psi^(k)(t)|, psi decreasing from 1 to 0. @param order k, 0 <= k <= dim(). @param t n values >= 0 (at t = 0
  /// the limit, possibly inf). @return n values. @throws std::domain_error for another order or a negative t.
  [[nodiscard]] Column log_abs_dpsi(int order, const ColumnRef& t) const;

 protected:
  using Copula::Copula;

 private:
  virtual void log_abs_dpsi_into(int order, const ColumnRef& t, ColumnOut out) const = 0;
};

}  // namespace sklar
