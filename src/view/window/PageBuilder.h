// Helps the screens to fill a page: looks words up, places text and buttons by the measures, on the
// side of the hand that taps.
#pragma once

#include <string>
#include <vector>

#include "experiment/ScreenState.h"
#include "experiment/ScreenTexts.h"
#include "view/window/Measures.h"
#include "view/window/Page.h"
#include "view/window/Typeface.h"

namespace heft {

class PageBuilder {
 public:
  PageBuilder(const ScreenTexts& texts, const Typeface& face, const Measures& sizes, bool left_hand)
      : measures(sizes), typeface(face), left_handed(left_hand), texts_(texts) {}

  const std::string& text(const std::string& of_page, const std::string& key) const {
    return texts_.at(of_page, key);
  }

  /// Lines below each other; an empty one is half as high.
  /// @return the bottom of the last
  float add_lines(const std::vector<std::string>& lines, float x, float y, float size_px,
                  Tone tone = Tone::strong);
  float height_px(const std::vector<std::string>& lines, float size_px) const;

  Control& add_button(std::string name, const Rect& area, std::string words, Effect effect,
                      char key = 0);

  /// The i-th button of the row along the lower edge, counted from the side of the hand.
  Rect bottom_button(int i) const;
  /// Where text pages write: centered, of a width that reads well, above the row of buttons.
  Rect text_area() const;

  Page page;
  const Measures& measures;
  const Typeface& typeface;
  const bool left_handed;

 private:
  const ScreenTexts& texts_;
};

/// A touch that is no answer: it turns the page, or asks for something.
Touch touch_of(TouchKind kind);

inline constexpr char key_enter = '\r', key_backspace = '\b';

}  // namespace heft
