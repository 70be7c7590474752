#pragma once
/// Vector kernels of one copula: whole batches in the widest instruction set of the machine.

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include "copula/accuracy.hpp"
#include "copula/types.hpp"

namespace sklar {

/// A view of n points of d coordinates: coordinate k of point i at first[k * stride + i].
struct Rows {
  explicit Rows(const PointsRef& u) : first(u.data()), stride(u.outerStride()), count(u.rows()), columns(u.cols()) {}

  const double* first;
  Index stride, count, columns;
};

/// A probability or its complement.
enum class Tail { lower, upper };

/// Which rows of a batch have an answer. none: nothing is written.
enum class Answered { none, some, all };

/// Each function fills rows.count values, with NaN for the rows that it leaves: those on the boundary or outside the
/// unit cube, of an unusual size, or whose error estimate is above the tolerance of that accuracy. What it answers
/// meets it.
class Kernels {
 public:
  virtual ~Kernels() = default;
  /// @param rows of as many columns as the copula has.
  virtual Answered log_pdf(Accuracy accuracy, const Rows& rows, double* out) const = 0;
  virtual Answered conditional(Accuracy accuracy, const Rows& rows, Tail tail, double* out) const = 0;
  virtual Answered conditional_inverse(Accuracy accuracy, const Rows& rows, Tail tail, double* out) const = 0;
};

/// The functions of one instruction set and precision, as of Kernels.
template <class Constants>
struct KernelFunctions {
  Answered (*log_pdf)(const Constants&, const Rows&, double*);
  Answered (*conditional)(const Constants&, const Rows&, Tail, double*);
  Answered (*conditional_inverse)(const Constants&, const Rows&, Tail, double*);
};

/// What one instruction set offers for a family.
template <class Constants>
struct KernelTable {
  KernelFunctions<Constants> standard, fast;
};

/// The kernels of one copula. @param table of static storage.
template <class Constants>
[[nodiscard]] std::shared_ptr<const Kernels> make_kernels(Constants constants, const KernelTable<Constants>& table) {
  class Implementation final : public Kernels {
   public:
    Implementation(Constants constants, const KernelTable<Constants>& table)
        : constants_(std::move(constants)), table_(table) {}

    Answered log_pdf(Accuracy accuracy, const Rows& rows, double* out) const override {
      return functions(accuracy).log_pdf(constants_, rows, out);
    }
    Answered conditional(Accuracy accuracy, const Rows& rows, Tail tail, double* out) const override {
      return functions(accuracy).conditional(constants_, rows, tail, out);
    }
    Answered conditional_inverse(Accuracy accuracy, const Rows& rows, Tail tail, double* out) const override {
      return functions(accuracy).conditional_inverse(constants_, rows, tail, out);
    }

   private:
    [[nodiscard]] const KernelFunctions<Constants>& functions(Accuracy accuracy) const {
      return accuracy == Accuracy::fast ? table_.fast : table_.standard;
    }

    Constants constants_;
    const KernelTable<Constants>& table_;
  };
  return std::make_shared<Implementation>(std::move(constants), table);
}

}  // namespace sklar
