#include "brdf/analytic/info.hpp"

#include <map>
#include <stdexcept>
#include <string_view>

#include "brdf/analytic/check.hpp"

namespace sklar::brdf {
namespace {

void require_count(const AnalyticInfo& info, const AnalyticValues& values) {
  if (values.size() == info.size()) return;
  throw std::invalid_argument(info.name + ": takes " + std::to_string(info.size()) + " values, got " +
                              std::to_string(values.size()));
}

}  // namespace

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

AnalyticValues AnalyticInfo::isotropic(AnalyticValues values) const {
  require_count(*this, values);
  std::map<std::string_view, double> scalars;
  std::size_t next = 0;
  for (const AnalyticParameter& parameter : parameters) {
    if (!parameter.isotropic_as.empty()) values[next] = scalars.at(parameter.isotropic_as);
    if (!parameter.per_channel) scalars[parameter.name] = values[next];
    next += parameter.per_channel ? 3 : 1;
  }
  return values;
}

BrdfPtr AnalyticInfo::make(const AnalyticValues& values) const {
  require_count(*this, values);
  std::size_t next = 0;
  for (const AnalyticParameter& parameter : parameters) {
    for (int channel = 0; channel < (parameter.per_channel ? 3 : 1); ++channel) {
      require_inside(name, parameter.name, parameter.bounds, values[next++]);
    }
  }
  return make_unchecked(values);
}

}  // namespace sklar::brdf
