#pragma once
/// The coefficients of a model as they are stored: numbers of evenly spaced levels, with one range a part.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sklar::brdf {

/// Coefficients next to each other that share a range and a number of bits.
struct CoefficientRun {
  std::size_t part, first, count;
  int bits;
};

/// Coefficients rounded to one of 2^bits evenly spaced levels.
struct PackedCoefficients {
  int bits = 16;                        ///< 6 to 16; a layout may give a part more
  std::array<float, 5> lowest = {};     ///< of each part
  std::array<float, 5> step = {};       ///< between levels
  std::vector<std::uint16_t> levels{};  ///< in the order of the layout
};

/// The nearest levels, between the least and the largest coefficient of each part.
[[nodiscard]] PackedCoefficients pack_runs(const std::vector<CoefficientRun>& runs, int bits,
                                           const std::vector<double>& coefficients);

/// The coefficients that the levels stand for, rounded to single precision.
[[nodiscard]] std::vector<double> unpack_runs(const std::vector<CoefficientRun>& runs,
                                              const PackedCoefficients& packed);

/// @param layout RefinedLayout or AnisotropicLayout.
template <class Layout>
[[nodiscard]] PackedCoefficients pack(const Layout& layout, int bits, const std::vector<double>& coefficients) {
  return pack_runs(layout.runs(bits), bits, coefficients);
}

/// The coefficients, as they were rounded.
template <class Layout>
[[nodiscard]] std::vector<double> unpack(const Layout& layout, const PackedCoefficients& packed) {
  return unpack_runs(layout.runs(packed.bits), packed);
}

/// Bytes of the levels, bit by bit.
[[nodiscard]] std::size_t packed_bytes(const std::vector<CoefficientRun>& runs);

/// @throws std::invalid_argument naming the model unless 6 <= bits <= 16.
void require_bits(const std::string& model, int bits);

/// @throws std::invalid_argument naming the model for bits out of range, a number of levels other than that of the
/// runs, a level that does not fit its bits, a range that is not finite.
void require_packed(const std::string& model, const std::vector<CoefficientRun>& runs,
                    const PackedCoefficients& packed);

}  // namespace sklar::brdf
