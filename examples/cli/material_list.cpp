#include "examples/cli/material_list.hpp"

#include <filesystem>
#include <sstream>

#include "brdf/data/material.hpp"
#include "copula/error.hpp"
#include "copula/file.hpp"
#include "examples/cli/material.hpp"

namespace sklar::cli {
namespace {

std::string trimmed(const std::string& line) {
  const char* const blanks = " \t\r";
  const std::size_t begin = line.find_first_not_of(blanks);
  return begin == std::string::npos ? "" : line.substr(begin, line.find_last_not_of(blanks) + 1 - begin);
}

class MaterialList {
 public:
  void add_list(const std::string& path) {
    const std::size_t before = materials_.size();
    std::istringstream text(read_file(path));
    std::string line;
    for (int number = 1; std::getline(text, line); ++number) {
      const std::string entry = trimmed(line);
      if (entry.empty() || entry.front() == '#') continue;
      try {
        add(entry == kSynthetic ? entry : (std::filesystem::path(path).parent_path() / entry).string());
      } catch (const FileError& error) {
        throw FileError(path + ": line " + std::to_string(number), error.what());
      }
    }
    if (materials_.size() == before) throw FileError(path, "names no material");
  }

  void add(const std::string& path) {
    if (path != kSynthetic) brdf::require_material_file(path);
    const std::string name = brdf::material_name(path);
    for (const ListedMaterial& other : materials_) {
      if (other.name != name) continue;
      throw FileError(path, "has the name of another material, " + name + " (" + other.path + "); names must differ");
    }
    materials_.push_back({path, name});
  }

  [[nodiscard]] const std::vector<ListedMaterial>& materials() const { return materials_; }

 private:
  std::vector<ListedMaterial> materials_{};
};

}  // namespace

std::vector<ListedMaterial> listed_materials(const std::vector<std::string>& arguments) {
  MaterialList list;
  for (const std::string& argument : arguments) {
    if (std::filesystem::path(argument).extension() == ".txt") {
      list.add_list(argument);
    } else {
      list.add(argument);
    }
  }
  return list.materials();
}

}  // namespace sklar::cli
