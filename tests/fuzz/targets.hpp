#pragma once
/// The readers of what comes from outside, each as a function of bytes: for libFuzzer and for fuzz_test.

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace sklar::test {

struct FuzzTarget {
  const char* name;                         ///< also of its folder in tests/fuzz/corpus
  bool (*is_read)(std::string_view bytes);  ///< false: refused in the documented way; every other exception is a fault
  int mutations;                            ///< inputs that fuzz_test makes: a fraction of a second's work
};

[[nodiscard]] std::span<const FuzzTarget> copula_targets();
[[nodiscard]] std::span<const FuzzTarget> brdf_targets();
[[nodiscard]] std::span<const FuzzTarget> command_targets();

/// Whether read() returned; its documented refusal must be a Refusal.
template <class Refusal, class Read>
bool returned(const Read& read) {
  try {
    read();
  } catch (const Refusal&) {
    return false;
  }
  return true;
}

/// What was read must be read again from what is written of it. @throws std::runtime_error otherwise.
inline void require_same(std::string_view written, std::string_view written_again) {
  if (written != written_again) throw std::runtime_error("'" + std::string(written) + "' is not read as written");
}

}  // namespace sklar::test
