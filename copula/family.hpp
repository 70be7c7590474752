#pragma once
/// FamilyInfo: the value by which everything outside a family's own file knows the family.

#include <functional>
#include <string>
#include <vector>

#include "copula/copula.hpp"
#include "copula/rotation.hpp"

namespace sklar {

/// An interval of admissible values; an infinite end is open.
struct Interval {
  double lowest;
  double highest;
  bool lowest_included = true;
  bool highest_included = true;

  [[nodiscard]] bool contains(double value) const noexcept;  ///< false for NaN
  [[nodiscard]] std::string to_text() const;                 ///< as in "[1, inf)"
};

/// A parameter of a family.
struct ParameterInfo {
  std::string name;
  std::function<Interval(int dim)> domain;  ///< the mathematical domain in dimension dim
};

/// Coefficients of tail dependence of a pair.
struct TailDependence {
  double lower;
  double upper;
};

/// A family: what it is called, what parameters it has, and how to make a copula of it.
struct FamilyInfo {
  std::string name;    ///< registry key, lower case; with `@ROTATION` behind it where rotated
  std::string title;   ///< as printed
  std::string psi;     ///< textbook generator in t and the parameters, where rotated of the base; empty without one
  std::string source;  ///< reference with equation or page
  std::vector<ParameterInfo> parameters;
  std::vector<Theta>
      examples;  ///< weak, medium and extreme dependence; those admissible in a dimension are tested in it

  std::function<CopulaPtr(int dim, const Theta&)> make_unchecked;  ///< make without its checks
  std::function<double(const Theta&)> tau;            ///< Kendall's tau of any pair; NaN if pairs differ or unknown
  std::function<Theta(double tau)> theta_from_tau;    ///< inverse of tau; empty unless there is exactly one parameter
  std::function<TailDependence(const Theta&)> tails;  ///< lower and upper tail dependence coefficients; NaN as tau
  std::string definition{};  ///< of a family that is not registered: the JSON that makes it, to be stored with a model
  Dimensions dimensions{};   ///< that it has
  Rotation rotation{};       ///< see rotated_family.hpp

  /// @throws std::invalid_argument (number of parameters, dim < 2) or std::domain_error naming family, parameter,
  /// value, dimension and the admissible interval or dimensions.
  [[nodiscard]] CopulaPtr make(int dim, const Theta& theta) const;

  /// Whether the family has the dimension, and theta one value a parameter, each in its domain.
  [[nodiscard]] bool admits(int dim, const Theta& theta) const;

  /// Throws as make does.
  void require_dimension(int dim) const;
  void require_admissible(int dim, const Theta& theta) const;

  /// Range of tau over the admissible parameters in a dimension. Precondition: one parameter.
  [[nodiscard]] Interval tau_range(int dim) const;

  /// The copula with the given tau. @throws std::invalid_argument for a family without theta_from_tau,
  /// std::domain_error with the attainable range for tau outside it.
  [[nodiscard]] Theta from_tau(int dim, double value) const;
};

}  // namespace sklar
