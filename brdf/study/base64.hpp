#pragma once
/// Bytes and pictures as text.

#include <string>
#include <string_view>

#include "brdf/render/image.hpp"

namespace sklar::brdf {

/// Base64 by RFC 4648, section 4, padded.
[[nodiscard]] std::string base64(std::string_view bytes);

/// A PNG as a URL that holds it.
[[nodiscard]] std::string png_url(const Bytes& bytes);

}  // namespace sklar::brdf
