#include "brdf/analytic/registry.hpp"

#include <array>

#include "copula/find_named.hpp"

namespace sklar::brdf::analytic {

#include "brdf/analytic/declarations.inc"

std::span<const AnalyticInfo> all() {
  static const auto list = std::to_array<AnalyticInfo>({
#include "brdf/analytic/list.inc"
  });
  return list;
}

const AnalyticInfo& find(std::string_view name) {
  return find_named(name, all(), "reflectance model", "models");
}

}  // namespace sklar::brdf::analytic
