// Sizes of everything on a screen, from the window's size alone.
#pragma once

#include <algorithm>

namespace heft {

/// The rule: touch targets are at least 0.14 of the window's height (of 0.6 of its width, if that
/// is less). On a 7" touch screen of 1024 x 600 that is 84 px or 12.5 mm, at 1280 x 800 107 px or
/// 12.7 mm, on one of 1920 x 1080 151 px or 12.2 mm; on larger screens more.
struct Measures {
  float width, height;       ///< of the window, in pixels
  float target;              ///< least width and height of what can be tapped
  float gap, margin;         ///< between controls; around them
  float small, body, title;  ///< text

  Measures(float width_px, float height_px) : width(width_px), height(height_px) {
    const float unit = std::min(height_px, 0.6f * width_px);
    target = 0.14f * unit;
    gap = 0.016f * unit;
    margin = 0.025f * unit;
    small = 0.031f * unit;
    body = 0.042f * unit;
    title = 0.065f * unit;
  }
};

}  // namespace heft
