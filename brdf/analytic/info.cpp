#include "brdf/analytic/info.hpp"

#include <stdexcept>

#include "brdf/analytic/check.hpp"

namespace sklar::brdf {

std::size_t AnalyticInfo::size() const {
  std::size_t count = 0;
  for (const AnalyticParameter& parameter : parameters) count += parameter.per_channel ? 3 : 1;
  return count;
}

AnalyticValues AnalyticInfo::initial() const {
  AnalyticValues values;
  for (const AnalyticParameter& parameter : parameters) {
    values.insert(values.end(), parameter.per_channel ? 3 : 1, parameter.initial);
  }
  return values;
}

BrdfPtr AnalyticInfo::make(const AnalyticValues& values) const {
  if (values.size() != size()) {
    throw std::invalid_argument(name + ": takes " + std::to_string(size()) + " values, got " +
                                std::to_string(values.size()));
  }
  std::size_t next = 0;
  for (const AnalyticParameter& parameter : parameters) {
    for (int channel = 0; channel < (parameter.per_channel ? 3 : 1); ++channel) {
      require_inside(name, parameter.name, parameter.bounds, values[next++]);
    }
  }
  return make_unchecked(values);
}

}  // namespace sklar::brdf
