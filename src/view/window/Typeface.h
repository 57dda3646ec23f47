// The one typeface of the participant's screens: finds it, makes the characters that the texts need
// in the sizes that the screens use, measures and wraps text.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "experiment/ScreenTexts.h"
#include "view/window/Page.h"

struct ImFont;
struct ImFontAtlas;

namespace heft {

/// Text that was made to fit: perhaps smaller than wished for.
struct FittedText {
  float size_px = 0;
  std::vector<std::string> lines;
};

class Typeface {
 public:
  /// @throws Error (device_missing) when the typeface is not installed, Error (invalid_file) when
  /// it lacks a character of the texts
  Typeface(const ScreenTexts& texts, const Measures& measures);

  float width_px(const std::string& text, float size_px) const;
  static float line_height_px(float size_px) { return 1.3f * size_px; }

  /// Lines no wider than a width, broken at spaces (a longer word stands alone and sticks out). A
  /// single line end counts as a space; an empty line starts a paragraph and comes out empty.
  std::vector<std::string> wrapped(const std::string& text, float size_px, float width_px) const;

  /// The text wrapped at the largest of a few sizes from size_px down at which it fits.
  FittedText fitted(const std::string& text, float size_px, float width_px, float height_px) const;

  /// For drawing at a size: the smallest one made that is not smaller.
  const ImFont& font(float size_px) const;
  std::shared_ptr<ImFontAtlas> atlas() const { return atlas_; }

 private:
  std::shared_ptr<ImFontAtlas> atlas_;
  std::vector<ImFont*> fonts_;  ///< from small to large
};

}  // namespace heft
