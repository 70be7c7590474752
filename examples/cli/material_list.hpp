#pragma once
/// Materials named on the command line or in a list.

#include <string>
#include <vector>

namespace sklar::cli {

struct ListedMaterial {
  std::string path;  ///< as load_table takes it
  std::string name;  ///< of the table
};

/// Of each argument: a material file, the built-in material by its name, or a list LIST.txt of them, one a line,
/// relative to the folder of the list. A blank line and one that opens with # say nothing.
/// @throws FileError naming file and line: a missing file, an unknown extension, a name that another material has; a
/// list without materials.
[[nodiscard]] std::vector<ListedMaterial> listed_materials(const std::vector<std::string>& arguments);

}  // namespace sklar::cli
