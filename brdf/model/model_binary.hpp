#pragma once
/// A refined or anisotropic model in as many bytes as evaluation needs, and what it was fitted to.

#include <string>
#include <string_view>

#include "brdf/model/model_io.hpp"

namespace sklar::brdf {

/// How a file begins, and the newest version written and read.
inline constexpr std::string_view kBinaryMagic = "sklarbrdf";
inline constexpr int kBinaryVersion = 1;

/// All numbers little-endian. The magic; one byte each for the version, the mode (2 refined, 3 anisotropic, 4 refined
/// on part of its axes) and the provenance; the material, a text. A text is a 32-bit length and its bytes. A refined
/// model has the number of different families (a byte) and these, texts: a name or a definition as in to_json. Then
/// come Brdf::bytes bytes: the counts of the structure in the order of to_json, a byte each; of mode 4 the ends of both
/// ranges, a byte each; the width as a 32-bit float, or whether lobes are tilted in a byte; the bits; lowest and step
/// of each part, 32-bit floats; of a refined model one byte a component for its family; the levels, each with the bits
/// of its part, lowest bits first.
/// @throws std::invalid_argument for a model of mode "paper".
[[nodiscard]] std::string to_binary(const StoredBrdf& model);

/// @throws FileError naming the source: another version, what ends too early or too late, values that the model
/// refuses.
[[nodiscard]] StoredBrdf parse_binary(std::string_view bytes, std::string_view source);

}  // namespace sklar::brdf
