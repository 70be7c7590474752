/// fuzz TARGET [libFuzzer's options] [FOLDERS]; without a target, or with one that is unknown, their names.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>

#include "tests/fuzz/targets.hpp"

namespace {

const sklar::test::FuzzTarget* chosen = nullptr;

void choose(std::string_view name) {
  using namespace sklar::test;
  for (const auto targets : {copula_targets(), brdf_targets(), command_targets()}) {
    for (const FuzzTarget& target : targets) {
      if (name == target.name) chosen = &target;
      if (name.empty()) std::cout << target.name << '\n';
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  if (*argc > 1) choose((*argv)[1]);
  if (chosen == nullptr) {
    choose("");
    std::exit(*argc > 1 ? 1 : 0);
  }
  std::rotate(*argv + 1, *argv + 2, *argv + *argc);
  --*argc;
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  (void)chosen->is_read({reinterpret_cast<const char*>(bytes), size});
  return 0;
}
