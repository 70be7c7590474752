#include "families/registry.hpp"

#include <array>
#include <map>
#include <mutex>
#include <stdexcept>
#include <string>

#include "copula/error.hpp"
#include "copula/file.hpp"
#include "copula/symbolic/formula_family.hpp"

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

FamilyInfo from_definition(std::string_view json, std::string_view source) {
  const symbolic::FamilyDefinition definition = symbolic::parse_definition(json, source);
  for (const FamilyInfo& family : all()) {
    if (family.name != definition.name) continue;
    throw FileError(source, "field 'name': '" + family.name + "' is a registered family; choose another name");
  }
  try {
    return symbolic::make_family(definition);
  } catch (const std::logic_error& error) {
    throw FileError(source, error.what());
  }
}

const FamilyInfo& resolve(std::string_view name_or_path) {
  if (!name_or_path.ends_with(".json")) return find(name_or_path);
  static std::mutex mutex;
  static std::map<std::string, FamilyInfo, std::less<>> files;  // addresses stay
  const std::lock_guard lock(mutex);
  const auto known = files.find(name_or_path);
  if (known != files.end()) return known->second;
  const std::string path(name_or_path);
  return files.emplace(path, from_definition(read_file(path), path)).first->second;
}

}  // namespace sklar::families
