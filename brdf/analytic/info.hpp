#pragma once
/// AnalyticInfo: the value by which everything outside a reflectance model's own file knows the model.

#include <functional>
#include <string>
#include <vector>

#include "brdf/brdf.hpp"
#include "copula/family.hpp"

namespace sklar::brdf {

/// In which steps a search of a parameter goes.
enum class SearchScale {
  linear,      ///< equal differences
  logarithmic  ///< equal ratios of the value, or of the value + 1 where 0 is admissible
};

/// A parameter of an analytic model: one value, or one a channel.
struct AnalyticParameter {
  std::string name;
  Interval bounds;           ///< of each value, closed and finite
  double initial;            ///< the default of each value
  bool per_channel = false;  ///< three values, red, green, blue, each of which acts on its channel alone; else one
  SearchScale scale = SearchScale::linear;
  std::string isotropic_as = {};  ///< an earlier parameter that has the same value where isotropic; empty for none
};

/// The values of a model's parameters, one after another in the order of AnalyticInfo::parameters.
using AnalyticValues = std::vector<double>;

/// The value by which everything outside a model's own file knows the model.
struct AnalyticInfo {
  std::string name;    ///< registry key, lower case
  std::string title;   ///< as printed
  std::string source;  ///< reference with equation or page
  std::vector<AnalyticParameter> parameters;
  std::vector<AnalyticValues> examples;  ///< from smooth to rough, extremes included; the conformance tests visit each

  std::function<BrdfPtr(const AnalyticValues&)> make_unchecked;  ///< make, given values within their bounds

  /// The model of the list that this one is where isotropic, with the values but those of parameters with isotropic_as;
  /// empty for none.
  std::string isotropic_form = {};

  /// Number of values: one a parameter, three a parameter per channel.
  [[nodiscard]] std::size_t size() const;

  /// The defaults.
  [[nodiscard]] AnalyticValues initial() const;

  /// The values of an isotropic surface: those of parameters with isotropic_as are replaced.
  /// @throws std::invalid_argument unless values.size() == size().
  [[nodiscard]] AnalyticValues isotropic(AnalyticValues values) const;

  /// @throws std::invalid_argument unless values.size() == size(), std::domain_error naming model, parameter, bounds
  /// and value unless each is within its bounds.
  [[nodiscard]] BrdfPtr make(const AnalyticValues& values) const;
};

/// Three values from `first` on, of a parameter per channel. Precondition: they exist.
[[nodiscard]] inline Rgb rgb_at(const AnalyticValues& values, std::size_t first) {
  return {values[first], values[first + 1], values[first + 2]};
}

}  // namespace sklar::brdf
