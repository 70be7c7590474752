#include "brdf/basis/registry.hpp"

#include <array>
#include <stdexcept>

namespace sklar::brdf::basis {

#include "brdf/basis/declarations.inc"

std::span<const BasisInfo> all() {
  static const auto list = std::to_array<BasisInfo>({
#include "brdf/basis/list.inc"
  });
  return list;
}

const BasisInfo& find(std::string_view name) {
  std::string known;
  for (const BasisInfo& model : all()) {
    if (model.name == name) return model;
    known += (known.empty() ? "" : ", ") + model.name;
  }
  throw std::invalid_argument("unknown basis model '" + std::string(name) + "'; known models: " + known);
}

}  // namespace sklar::brdf::basis
