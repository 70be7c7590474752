#pragma once
/// Entries of a list by name.

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "copula/listed.hpp"

namespace sklar {

/// The entry of the list whose member `name` is that given. @param kind, kinds what an entry is called, and several.
/// @throws std::invalid_argument naming the unknown name and listing the known ones.
template <class Named>
[[nodiscard]] const Named& find_named(std::string_view name, std::span<const Named> list, const std::string& kind,
                                      const std::string& kinds) {
  for (const Named& entry : list) {
    if (entry.name == name) return entry;
  }
  throw std::invalid_argument("unknown " + kind + " '" + std::string(name) + "'; known " + kinds + ": " +
                              listed(list, &Named::name));
}

}  // namespace sklar
