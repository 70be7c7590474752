#include "examples/cli/material.hpp"

#include <unistd.h>

#include <cstdio>

#include "brdf/analytic/synthetic.hpp"
#include "brdf/data/material.hpp"

namespace sklar::cli {

void add_material(CLI::App& command, std::string& path) {
  command.add_option("MATERIAL", path, "MERL .binary or isotropic RGL .bsdf; the built-in material by default");
}

std::shared_ptr<const brdf::MeasuredTable> load_table(const std::string& path) {
  return std::make_shared<const brdf::MeasuredTable>(path.empty() ? brdf::builtin_material()
                                                                  : brdf::load_material(path));
}

std::shared_ptr<const brdf::TableBrdf> load_brdf(const std::string& path) {
  return std::make_shared<const brdf::TableBrdf>(load_table(path));
}

brdf::Progress progress_bar(std::string label) {
  if (::isatty(STDERR_FILENO) == 0) return {};
  return [label = std::move(label)](double share) {
    constexpr int kWidth = 40;
    const int done = static_cast<int>(share * kWidth);
    std::fprintf(stderr, "\r%s [%s%s] %3.0f %%%s", label.c_str(), std::string(done, '#').c_str(),
                 std::string(kWidth - done, ' ').c_str(), 100 * share, share < 1 ? "" : "\n");
  };
}

}  // namespace sklar::cli
