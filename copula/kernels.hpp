#pragma once
/// Vector kernels of one copula: whole batches in the widest instruction set of the machine.

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include "copula/types.hpp"

namespace sklar {

/// A view of n points of d coordinates: coordinate k of point i at first[k * stride + i].
struct Rows {
  explicit Rows(const PointsRef& u) : first(u.data()), stride(u.outerStride()), count(u.rows()), columns(u.cols()) {}

  const double* first;
  Index stride, count, columns;
};

enum class Tail { lower, upper };  ///< a probability or its complement

/// Each function fills rows.count values, with NaN for the rows that it leaves to the exact route: those on the
/// boundary, of an unusual size, or whose error estimate is above the tolerance. What it answers meets the bounds of
/// Archimedean.
class Kernels {
 public:
  virtual ~Kernels() = default;
  virtual void log_pdf(const Rows& rows, double* out) const = 0;  ///< rows.columns is the dimension of the copula
  virtual void conditional(const Rows& rows, Tail tail, double* out) const = 0;
  virtual void conditional_inverse(const Rows& rows, Tail tail, double* out) const = 0;
};

/// What one instruction set offers for a family; null where nothing.
template <class Constants>
struct KernelTable {
  using Function = void (*)(const Constants&, const Rows&, double*);
  using OfTail = void (*)(const Constants&, const Rows&, Tail, double*);

  Function log_pdf;
  OfTail conditional, conditional_inverse;
};

/// The kernels of one copula. @param table of static storage.
template <class Constants>
[[nodiscard]] std::shared_ptr<const Kernels> make_kernels(Constants constants, const KernelTable<Constants>& table) {
  class Implementation final : public Kernels {
   public:
    Implementation(Constants constants, const KernelTable<Constants>& table)
        : constants_(std::move(constants)), table_(table) {}

    void log_pdf(const Rows& rows, double* out) const override { table_.log_pdf(constants_, rows, out); }
    void conditional(const Rows& rows, Tail tail, double* out) const override {
      table_.conditional(constants_, rows, tail, out);
    }
    void conditional_inverse(const Rows& rows, Tail tail, double* out) const override {
      table_.conditional_inverse(constants_, rows, tail, out);
    }

   private:
    Constants constants_;
    const KernelTable<Constants>& table_;
  };
  return std::make_shared<Implementation>(std::move(constants), table);
}

}  // namespace sklar
