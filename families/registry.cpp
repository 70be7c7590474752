#include "families/registry.hpp"

#include <array>
#include <functional>
#include <map>
#include <mutex>
#include <string>

#include "copula/error.hpp"
#include "copula/file.hpp"
#include "copula/inference/model_io.hpp"
#include "copula/rotated_family.hpp"

namespace sklar::families {

#include "families/declarations.inc"

std::span<const FamilyInfo> all() {
  static const auto list = std::to_array<FamilyInfo>({
#include "families/list.inc"
  });
  return list;
}

namespace {

/// make() of the first call with this name.
const FamilyInfo& kept(std::string_view name, const std::function<FamilyInfo()>& make) {
  static std::mutex mutex;
  static std::map<std::string, FamilyInfo, std::less<>> families;  // addresses stay
  const std::lock_guard lock(mutex);
  const auto known = families.find(name);
  if (known != families.end()) return known->second;
  return families.emplace(name, make()).first->second;
}

/// Of a name, with base(name before the @).
template <class Base>
const FamilyInfo& find_rotated(std::string_view name, const Base& base) {
  const RotatedName parts = split_rotation(name);
  if (!parts.rotation) return base(name);
  const FamilyInfo& plain = base(parts.base);
  return kept(name, [&] { return rotated_family(plain, Rotation(*parts.rotation)); });
}

}  // namespace

const FamilyInfo& find(std::string_view name) {
  return find_rotated(name, [](std::string_view base) -> const FamilyInfo& { return find_family(base, all()); });
}

FamilyInfo from_definition(std::string_view json, std::string_view source) {
  FamilyInfo family = family_from_json(json, source, all());
  for (const FamilyInfo& registered : all()) {
    if (registered.name != split_rotation(family.name).base) continue;
    throw FileError(source, "field 'name': '" + registered.name + "' is a registered family; choose another name");
  }
  return family;
}

const FamilyInfo& resolve(std::string_view name_or_path) {
  return find_rotated(name_or_path, [](std::string_view base) -> const FamilyInfo& {
    if (!base.ends_with(".json")) return find(base);
    return kept(base, [path = std::string(base)] { return from_definition(read_file(path), path); });
  });
}

}  // namespace sklar::families
