#pragma once
/// Pictures ready to be shown.

#include <cstdint>
#include <vector>

namespace sklar::plot {

/// 8-bit sRGB bytes (IEC 61966-2-1), three a pixel, row by row from the top.
struct Bytes {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;
};

}  // namespace sklar::plot
