// The participant's screens: which page a session's ScreenState is, and what a tap on it means.
// Knows nothing of windows and events; WindowView shows its pages.
#pragma once

#include <optional>

#include "experiment/ScreenState.h"
#include "experiment/ScreenTexts.h"
#include "experiment/Touch.h"
#include "view/window/Page.h"
#include "view/window/ScreenPages.h"
#include "view/window/Typeface.h"

namespace heft {

class Screens {
 public:
  Screens(ScreenTexts texts, bool left_handed)
      : texts_(std::move(texts)), left_handed_(left_handed) {}

  /// Takes what the session offers now.
  /// @param cubes_shown whether the scene has cubes; without, nothing can be answered
  /// @return whether the page turned: then what a person was about to tap is gone
  bool show(const ScreenState& state, bool cubes_shown);

  /// Empty until something is shown.
  Page page(const Typeface& typeface, const Measures& measures) const;

  /// What the session must know of a tap on a control of the page; none: it changed this page only.
  std::optional<Touch> tapped(const Control& control);

  const ScreenTexts& texts() const { return texts_; }

 private:
  bool is_new_page(const ScreenState& state, bool cubes_shown) const;

  ScreenTexts texts_;
  bool left_handed_;
  bool shown_ = false;
  ScreenState state_;
  ScreenMemory memory_;
};

}  // namespace heft
