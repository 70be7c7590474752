#pragma once
/// The coordinates z in which a fit searches the parameters of a family.

#include <vector>

#include "copula/family.hpp"
#include "copula/inference/minimise.hpp"

namespace sklar {

/// One parameter whose tau has an inverse: z = atanh(tau), so that a step means the same in every family and the
/// sampling error of z is about 0.7/sqrt(n) throughout. Other parameters: z = theta for a bounded domain, and a scale
/// that is linear near a finite end and near 0, logarithmic far out, for an unbounded one. The bounds are those of the
/// domain; towards infinity the search ends at kLargestTheta, and at kLargestTau, where a tau in double determines
/// theta to half its digits.
class ParameterScale {
 public:
  static constexpr double kLargestTau = 1 - 0x1p-26;
  static constexpr double kLargestTheta = 1e15;

  /// Keeps a reference to the family.
  ParameterScale(const FamilyInfo& family, int dim);

  [[nodiscard]] std::size_t size() const noexcept { return domain_.size(); }
  [[nodiscard]] const Box& box() const noexcept { return box_; }
  [[nodiscard]] const std::vector<Interval>& domain() const noexcept { return domain_; }

  /// Whether z is atanh(tau).
  [[nodiscard]] bool by_tau() const noexcept { return by_tau_; }

  /// Admissible parameters. Precondition: z in the box.
  [[nodiscard]] Theta theta(const std::vector<double>& z) const;

  /// The z in the box nearest to that of admissible parameters.
  [[nodiscard]] std::vector<double> z(const Theta& theta) const;

  /// d theta_i / d z_i. Precondition: z in the box, not by_tau().
  [[nodiscard]] std::vector<double> slope(const std::vector<double>& z) const;

  /// Admissible parameter with the attainable tau nearest to this one. Precondition: by_tau().
  [[nodiscard]] Theta theta_at_tau(double tau) const;

  /// The z in the box nearest to that of a tau. Precondition: by_tau().
  [[nodiscard]] std::vector<double> at_tau(double tau) const;

  /// Fixed points of the box to compare before a local search: a line from end to end, evenly spaced in z, and where
  /// not by_tau() the examples of the family.
  [[nodiscard]] std::vector<std::vector<double>> lattice() const;

  /// Distance between neighbours on that line, along the shortest side.
  [[nodiscard]] double spacing() const;

 private:
  [[nodiscard]] Box lattice_box() const;

  const FamilyInfo* family_;
  std::vector<Interval> domain_;
  bool by_tau_;
  Interval tau_{-1, 1};  ///< attainable where by_tau_
  Box box_;
};

}  // namespace sklar
