#include "copula/archimedean_copula.hpp"

#include <cmath>
#include <limits>

#include "copula/error.hpp"

namespace sklar {

void ArchimedeanCopula::require_derivative(int order, const ColumnRef& t) const {
  if (order < 0 || order > dim()) {
    throw std::domain_error("log_abs_dpsi: order must be 0 to " + std::to_string(dim()) + ", got " +
                            std::to_string(order));
  }
  for (Index row = 0; row < t.size(); ++row) {
    if (t(row) < 0) {
      throw std::domain_error("log_abs_dpsi: t must be >= 0, got t(" + std::to_string(row) + ") = " + to_text(t(row)));
    }
  }
}

void ArchimedeanCopula::require_few(const Reflection& reflection) {
  if (reflection.count() <= kMostReflected) return;
  throw std::domain_error("log_cdf: of a rotated copula at most " + std::to_string(kMostReflected) +
                          " coordinates may be reflected, got " + std::to_string(reflection.count()));
}

Column ArchimedeanCopula::log_abs_dpsi(int order, const ColumnRef& t) const {
  require_derivative(order, t);
  Column out(t.size());
  log_abs_dpsi_into(order, t, out);
  return out;
}

Column ArchimedeanCopula::kendall(const ColumnRef& v, Tail tail) const {
  require_unit_cube("kendall", "v", PointsRef(v));
  Column out(v.size());
  kendall_into(v, tail, out);
  return out;
}

Column ArchimedeanCopula::kendall_cdf(const ColumnRef& v) const {
  return kendall(v, Tail::lower);
}

Column ArchimedeanCopula::kendall_survival(const ColumnRef& v) const {
  return kendall(v, Tail::upper);
}

std::vector<BigFloat> ArchimedeanCopula::exact_log_abs_dpsi(int order, const ColumnRef& t, int digits) const {
  require_digits(digits);
  require_derivative(order, t);
  std::vector<BigFloat> values;
  for (const double at : t) {
    values.push_back(std::isnan(at) ? std::numeric_limits<BigFloat>::quiet_NaN()
                                    : exact_log_abs_dpsi_at(order, at, digits));
  }
  return values;
}

}  // namespace sklar
