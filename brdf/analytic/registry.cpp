#include "brdf/analytic/registry.hpp"

#include <array>
#include <stdexcept>

namespace sklar::brdf::analytic {

#include "brdf/analytic/declarations.inc"

std::span<const AnalyticInfo> all() {
  static const auto list = std::to_array<AnalyticInfo>({
#include "brdf/analytic/list.inc"
  });
  return list;
}

const AnalyticInfo& find(std::string_view name) {
  std::string known;
  for (const AnalyticInfo& model : all()) {
    if (model.name == name) return model;
    known += (known.empty() ? "" : ", ") + model.name;
  }
  throw std::invalid_argument("unknown reflectance model '" + std::string(name) + "'; known models: " + known);
}

}  // namespace sklar::brdf::analytic
