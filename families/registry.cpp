#include "families/registry.hpp"

#include <array>
#include <stdexcept>
#include <string>

namespace sklar::families {

#include "families/declarations.inc"

std::span<const FamilyInfo> all() {
  static const auto list = std::to_array<FamilyInfo>({
#include "families/list.inc"
  });
  return list;
}

const FamilyInfo& find(std::string_view name) {
  std::string known;
  for (const FamilyInfo& family : all()) {
    if (family.name == name) return family;
    known += (known.empty() ? "" : ", ") + family.name;
  }
  throw std::invalid_argument("unknown family '" + std::string(name) + "'; known families: " + known);
}

}  // namespace sklar::families
