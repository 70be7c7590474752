#include "copula/archimedean_copula.hpp"

#include "copula/error.hpp"

namespace sklar {

Column ArchimedeanCopula::log_abs_dpsi(int order, const ColumnRef& t) const {
  if (order < 0 || order > dim()) {
    throw std::domain_error("log_abs_dpsi: order must be 0 to " + std::to_string(dim()) + ", got " +
                            std::to_string(order));
  }
  for (Index row = 0; row < t.size(); ++row) {
    if (t(row) < 0) {
      throw std::domain_error("log_abs_dpsi: t must be >= 0, got t(" + std::to_string(row) + ") = " + to_text(t(row)));
    }
  }
  Column out(t.size());
  log_abs_dpsi_into(order, t, out);
  return out;
}

}  // namespace sklar
