// An 8-bit picture. Interfaces between folders use it instead of a library's type.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace heft {

/// Rows from the top, channels interleaved: 1 (gray) or 3 (blue, green, red).
struct Image {
  int width = 0, height = 0, channels = 3;
  std::vector<std::uint8_t> pixels;

  Image() = default;
  Image(int width_px, int height_px, int n_channels)
      : width(width_px),
        height(height_px),
        channels(n_channels),
        pixels(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px) *
               static_cast<std::size_t>(n_channels)) {}

  bool empty() const { return pixels.empty(); }
  std::size_t row_bytes() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(channels);
  }
};

}  // namespace heft
