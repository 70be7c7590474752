#include "brdf/basis/registry.hpp"

#include <array>

#include "copula/find_named.hpp"

namespace sklar::brdf::basis {

#include "brdf/basis/declarations.inc"

std::span<const BasisInfo> all() {
  static const auto list = std::to_array<BasisInfo>({
#include "brdf/basis/list.inc"
  });
  return list;
}

const BasisInfo& find(std::string_view name) {
  return find_named(name, all(), "basis model", "models");
}

}  // namespace sklar::brdf::basis
