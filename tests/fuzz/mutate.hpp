#pragma once
/// Seeded changes of an input, of the kinds that break readers.

#include <algorithm>
#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <string_view>

namespace sklar::test {

class Mutator {
 public:
  explicit Mutator(std::string_view seed) : random_(seed_of(seed)) {}

  /// One of the inputs with one to four changes.
  std::string next(std::span<const std::string> inputs) {
    std::string bytes = inputs[below(inputs.size())];
    for (std::size_t left = 1 + below(4); left > 0; --left) change(bytes, inputs[below(inputs.size())]);
    return bytes;
  }

 private:
  static std::uint64_t seed_of(std::string_view text) {  // FNV-1a
    std::uint64_t hash = 14695981039346656037U;
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211U;
    return hash;
  }

  std::size_t below(std::size_t count) { return count == 0 ? 0 : random_() % count; }

  void change(std::string& bytes, const std::string& other) {
    const std::size_t at = below(bytes.size());
    const std::size_t count = below(std::min<std::size_t>(bytes.size() - at, 32)) + 1;
    switch (below(8)) {
      case 0:
        if (!bytes.empty()) bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
        break;
      case 1:
        bytes.resize(at);
        break;
      case 2:
        bytes.erase(at, count);
        break;
      case 3:
        bytes.insert(at, bytes.substr(at, count));
        break;
      case 4:
        bytes.insert(at, 1 + below(4), static_cast<char>(random_()));
        break;
      case 5:
        overwrite(bytes, at);
        break;
      case 6:
        replace_number(bytes, at);
        break;
      default:
        bytes = bytes.substr(0, at) + other.substr(below(other.size()));
    }
  }

  /// By a whole number of 1 to 8 bytes, little-endian, that is small, large or at a limit.
  void overwrite(std::string& bytes, std::size_t at) {
    constexpr std::uint64_t kNumbers[] = {0,
                                          1,
                                          2,
                                          0x7F,
                                          0x80,
                                          0xFF,
                                          0x7FFF,
                                          0xFFFF,
                                          0x7FFFFFFF,
                                          0x80000000,
                                          0xFFFFFFFF,
                                          0x100000001,
                                          0x7FFFFFFFFFFFFFFF,
                                          0xFFFFFFFFFFFFFFFF};
    const std::uint64_t number = kNumbers[below(std::size(kNumbers))];
    const std::size_t size = std::min<std::size_t>(std::size_t{1} << below(4), bytes.size() - at);
    for (std::size_t i = 0; i < size; ++i) bytes[at + i] = static_cast<char>(number >> (8 * i));
  }

  /// The next number of a text, by one that is not expected there.
  void replace_number(std::string& bytes, std::size_t at) {
    constexpr std::string_view kDigits = "0123456789.eE+-";
    constexpr std::string_view kNumbers[] = {
        "0",   "-1",  "1", "1e400",   "-1e308", "4294967297", "99999999999999999999", "1e-320", "nan",
        "inf", "0.5", "7", "1000000", "[]",     "\"\""};
    const std::size_t first = bytes.find_first_of(kDigits, at);
    if (first == std::string::npos) return;
    const std::size_t last = std::min(bytes.find_first_not_of(kDigits, first), bytes.size());
    bytes.replace(first, last - first, kNumbers[below(std::size(kNumbers))]);
  }

  std::mt19937_64 random_;
};

}  // namespace sklar::test
