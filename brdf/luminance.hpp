#pragma once
/// The brightness that samplers follow.

#include "brdf/brdf.hpp"

namespace sklar::brdf {

/// Luminance of linear red, green and blue with the primaries of Rec. 709 (ITU-R BT.709-6, 3.2).
[[nodiscard]] inline double luminance(const Rgb& rgb) {
  return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

}  // namespace sklar::brdf
