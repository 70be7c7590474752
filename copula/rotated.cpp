#include "copula/rotated.hpp"

#include <stdexcept>
#include <string>

namespace sklar {

namespace {

int dim_of(const CopulaPtr& base) {
  if (base == nullptr) throw std::invalid_argument("a rotated copula needs a base, got none");
  return base->dim();
}

}  // namespace

Rotated::Rotated(CopulaPtr base, std::vector<bool> reflected) : Copula(dim_of(base)), base_(std::move(base)) {
  if (reflected.size() != static_cast<std::size_t>(dim())) {
    throw std::invalid_argument("a rotated copula of dimension " + std::to_string(dim()) +
                                " needs one entry a coordinate, got " + std::to_string(reflected.size()));
  }
  reflection_ = Reflection(std::move(reflected));
}

void Rotated::log_pdf_into(const PointsRef& u, const Reflection& reflection, ColumnOut out) const {
  base_->log_pdf_into(u, reflection_ ^ reflection, out);
}

void Rotated::log_cdf_into(const PointsRef& u, const Reflection& reflection, ColumnOut out) const {
  base_->log_cdf_into(u, reflection_ ^ reflection, out);
}

void Rotated::conditional_into(const PointsRef& u, const Reflection& reflection, Tail tail, ColumnOut out) const {
  base_->conditional_into(u, reflection_ ^ reflection, tail, out);
}

void Rotated::conditional_inverse_into(const PointsRef& u, const Reflection& reflection, Tail tail,
                                       ColumnOut out) const {
  base_->conditional_inverse_into(u, reflection_ ^ reflection, tail, out);
}

BigFloat Rotated::exact_row(Quantity quantity, std::span<const BigFloat> u, const Reflection& reflection,
                            int digits) const {
  return base_->exact_row(quantity, u, reflection_ ^ reflection, digits);
}

void Rotated::draw(Route route, const Reflection& reflection, Rng& rng, std::span<double> u) const {
  base_->draw(route, reflection_ ^ reflection, rng, u);
}

CopulaPtr survival_copula(CopulaPtr base) {
  const auto dim = static_cast<std::size_t>(dim_of(base));
  return std::make_shared<Rotated>(std::move(base), std::vector<bool>(dim, true));
}

}  // namespace sklar
