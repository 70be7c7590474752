#include "copula/inference/objective.hpp"

#include <cmath>

#include "copula/inference/chunks.hpp"

namespace sklar {
namespace {

/// sum w_i term_i; no weights means one each. A finite total has finite terms: only else are rows looked at one by one.
RowSum weighted_sum(const Column& term, const ColumnRef& weights) {
  const bool weighted = weights.size() > 0;
  const double total = weighted ? (weights * term).sum() : term.sum();
  if (std::isfinite(total)) return {.value = total};
  RowSum sum;
  for (Index i = 0; i < term.size(); ++i) {
    const double weight = weighted ? weights[i] : 1.0;
    if (weight == 0) continue;
    if (std::isfinite(term[i])) {
      sum.value += weight * term[i];
    } else {
      ++sum.nonfinite;
      sum.nonfinite_weight += weight;
    }
  }
  return sum;
}

Index segment_length(const ColumnRef& weights, Index count) {
  return weights.size() > 0 ? count : 0;
}

template <class Distribution>
RowSum sum_of_log_densities(const Distribution& distribution, const PointsRef& x, const ColumnRef& weights,
                            const Chunking& chunking) {
  return sum_over_chunks(x.rows(), chunking, RowSum(), [&](Index first, Index count) {
    const Column term = distribution.log_pdf(x.middleRows(first, count));
    return weighted_sum(term, weights.segment(weights.size() > 0 ? first : 0, segment_length(weights, count)));
  });
}

}  // namespace

RowSum& RowSum::operator+=(const RowSum& other) {
  value += other.value;
  nonfinite += other.nonfinite;
  nonfinite_weight += other.nonfinite_weight;
  return *this;
}

RowSum log_likelihood(const Copula& copula, const PointsRef& u, const ColumnRef& weights, const Chunking& chunking) {
  return sum_of_log_densities(copula, u, weights, chunking);
}

RowSum log_likelihood(const JointDensity& joint, const PointsRef& x, const ColumnRef& weights,
                      const Chunking& chunking) {
  return sum_of_log_densities(joint, x, weights, chunking);
}

RowSum squared_error(const Copula& copula, const CellTable& cells, const Chunking& chunking) {
  const ColumnRef weights = cells.weight;
  return sum_over_chunks(cells.u.rows(), chunking, RowSum(), [&](Index first, Index count) {
    const auto margin = cells.margin.segment(first, count);
    Column model = Column::Zero(count);
    if ((margin > 0).any()) {
      // A cell whose margin has no mass has none in the model, whatever the density of the copula there.
      model = (margin > 0).select(copula.pdf(cells.u.middleRows(first, count)) * margin, 0.0);
    }
    return weighted_sum((cells.mass.segment(first, count) - model).square(),
                        weights.segment(weights.size() > 0 ? first : 0, segment_length(weights, count)));
  });
}

}  // namespace sklar
