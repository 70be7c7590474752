#include "examples/cli/material.hpp"

#include <unistd.h>

#include <cstdint>
#include <cstdio>

#include "brdf/analytic/synthetic.hpp"
#include "brdf/data/anisotropic_brdf.hpp"
#include "brdf/data/isotropy.hpp"
#include "brdf/data/table_brdf.hpp"
#include "brdf/model/model_io.hpp"
#include "brdf/sampling/sampled_brdf.hpp"
#include "copula/file.hpp"

namespace sklar::cli {
namespace {

bool is_synthetic(const std::string& path) {
  return path.empty() || path == kSynthetic;
}

std::string hexadecimal(std::uint64_t value) {
  std::string digits(16, '0');
  for (auto digit = digits.rbegin(); digit != digits.rend(); ++digit, value >>= 4)
    *digit = "0123456789abcdef"[value & 15];
  return digits;
}

/// Fowler, Noll and Vo; RFC 9923.
std::uint64_t fnv1a(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3;
  return hash;
}

}  // namespace

void add_material(CLI::App& command, std::string& path) {
  command.add_option("MATERIAL", path, kMaterialHelp);
}

std::shared_ptr<const brdf::MeasuredTable> load_table(const std::string& path, brdf::Provenance provenance) {
  if (path == brdf::kAnisotropicSynthetic)
    throw brdf::anisotropic_error(path, brdf::isotropy_deviation(*brdf::brushed_metal()));
  return std::make_shared<const brdf::MeasuredTable>(is_synthetic(path) ? brdf::builtin_material()
                                                                        : brdf::load_material(path, provenance));
}

std::string inputs_of(const std::string& path, brdf::Provenance provenance) {
  const std::string version = "sklar " SKLAR_VERSION ", ";
  if (is_synthetic(path)) return version + kSynthetic;
  return version + "provenance " + to_text(provenance) + ", content " + hexadecimal(fnv1a(read_file(path)));
}

brdf::Material load_any_table(const std::string& path, brdf::Provenance provenance) {
  if (path == brdf::kAnisotropicSynthetic) return brdf::builtin_anisotropic_material();
  if (is_synthetic(path)) return brdf::builtin_material();
  return brdf::read_material(path, provenance);
}

brdf::BrdfPtr load_brdf(const std::string& path) {
  if (path == brdf::kAnisotropicSynthetic) {
    return std::make_shared<const brdf::AnisotropicTableBrdf>(
        std::make_shared<const brdf::AnisotropicTable>(brdf::builtin_anisotropic_material()));
  }
  if (is_synthetic(path)) return std::make_shared<const brdf::TableBrdf>(load_table(path));
  if (brdf::is_model_path(path)) return brdf::read_brdf(path).brdf();
  return brdf::read_material_brdf(path);
}

brdf::BrdfPtr load_sampled_brdf(const std::string& path) {
  return std::make_shared<const brdf::SampledBrdf>(load_brdf(path));
}

brdf::BrdfPtr load_isotropic_brdf(const std::string& path) {
  brdf::BrdfPtr material = load_brdf(path);
  if (!material->traits().isotropic) throw brdf::anisotropic_error(path, brdf::isotropy_deviation(*material));
  return material;
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

StepLine::StepLine() : visible_(::isatty(STDERR_FILENO) != 0) {}

StepLine::~StepLine() {
  show("");
}

void StepLine::show(const std::string& what) const {
  if (visible_) std::fprintf(stderr, "\r\x1b[K%s", what.c_str());
}

}  // namespace sklar::cli
