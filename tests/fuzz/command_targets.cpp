#include <array>

#include "copula/error.hpp"
#include "examples/cli/table.hpp"
#include "tests/fuzz/memory_file.hpp"
#include "tests/fuzz/targets.hpp"

namespace sklar::test {
namespace {

/// What `sklar copula table` reads.
bool table(std::string_view bytes) {
  const MemoryFile file(bytes);
  return returned<FileError>([&] { (void)cli::read_table(file.path()); });
}

constexpr std::array<FuzzTarget, 1> kTargets{{{"table", table, 5000}}};

}  // namespace

std::span<const FuzzTarget> command_targets() {
  return kTargets;
}

}  // namespace sklar::test
