#include "brdf/analytic/search_space.hpp"

#include <algorithm>
#include <cmath>

namespace sklar::brdf {
namespace {

constexpr double kChannelOffset = 0.01;
constexpr double kLinear = -1;

double offset_of(const AnalyticParameter& parameter) {
  if (parameter.per_channel) return kChannelOffset;
  if (parameter.scale == SearchScale::linear) return kLinear;
  return parameter.bounds.lowest > 0 ? 0 : 1;
}

}  // namespace

double SearchSpace::Axis::to_coordinate(double x) const {
  const double inside = std::clamp(x, parameter->bounds.lowest, parameter->bounds.highest);
  return offset < 0 ? inside : std::log(inside + offset);
}

double SearchSpace::Axis::to_value(double z) const {
  if (z <= to_coordinate(parameter->bounds.lowest)) return parameter->bounds.lowest;
  return std::clamp(offset < 0 ? z : std::exp(z) - offset, parameter->bounds.lowest, parameter->bounds.highest);
}

SearchSpace::SearchSpace(const AnalyticInfo& info) : info_(info) {
  std::size_t next = 0;
  for (const AnalyticParameter& parameter : info.parameters) {
    const std::size_t count = parameter.per_channel ? 3 : 1;
    if (parameter.isotropic_as.empty()) {
      groups_.push_back({axes_.size(), count});
      for (std::size_t n = 0; n < count; ++n) axes_.push_back({next + n, &parameter, offset_of(parameter)});
    }
    next += count;
  }
  for (const Axis& axis : axes_) {
    box_.lower.push_back(axis.to_coordinate(axis.parameter->bounds.lowest));
    box_.upper.push_back(axis.to_coordinate(axis.parameter->bounds.highest));
  }
}

std::vector<double> SearchSpace::start(const std::vector<double>& shares) const {
  constexpr double kFactor = 30;
  std::vector<double> result = coordinates(info_.initial());
  auto share = shares.begin();
  for (const Group& group : groups_) {
    if (group.count > 1) continue;
    const Axis& axis = axes_[group.first];
    double lower = box_.lower[group.first];
    double upper = box_.upper[group.first];
    if (axis.offset >= 0) {
      lower = std::max(lower, axis.to_coordinate(axis.parameter->initial / kFactor));
      upper = std::min(upper, axis.to_coordinate(axis.parameter->initial * kFactor));
    }
    result[group.first] = lower + *share++ * (upper - lower);
  }
  return result;
}

std::vector<double> SearchSpace::coordinates(const AnalyticValues& values) const {
  std::vector<double> result;
  result.reserve(axes_.size());
  for (const Axis& axis : axes_) result.push_back(axis.to_coordinate(values[axis.value]));
  return result;
}

AnalyticValues SearchSpace::values(const std::vector<double>& coordinates) const {
  AnalyticValues result = info_.initial();
  for (std::size_t n = 0; n < axes_.size(); ++n) result[axes_[n].value] = axes_[n].to_value(coordinates[n]);
  return info_.isotropic(std::move(result));
}

}  // namespace sklar::brdf
