// The participant's screens: which page a session's ScreenState is, and what a tap on it means.
// Knows nothing of windows and events; WindowView shows its pages.
#pragma once

#include <limits>
#include <optional>

#include "experiment/ScreenState.h"
#include "experiment/ScreenTexts.h"
#include "view/screens/Page.h"
#include "view/screens/ScreenPages.h"
#include "view/text/Typeface.h"

namespace heft {

/// What became another with what the session offers.
enum class Turn {
  none,
  cubes,  ///< they appeared, and with them what can be answered
  page    ///< what a person was about to tap is gone
};

class Screens {
 public:
  Screens(ScreenTexts texts, bool left_handed)
      : texts_(std::move(texts)), left_handed_(left_handed) {}

  /// Takes what the session offers now.
  /// @param cubes_shown whether the scene has cubes; without, nothing can be answered
  Turn show(const ScreenState& state, bool cubes_shown);

  /// Empty until something is shown.
  /// @param up_s how long it has been on the display, as it is
  Page page(const Typeface& typeface, const Measures& measures,
            double up_s = std::numeric_limits<double>::infinity()) const;
  PageId page_id() const { return state_.page(); }

  /// What the session must know of a tap on a control of the page; none: it changed this page only.
  std::optional<Touch> tapped(const Control& control);

  const ScreenTexts& texts() const { return texts_; }

 private:
  Turn turn_to(const ScreenState& state, bool cubes_shown) const;
  void remember(const ScreenState& state);

  /// What a page that was paused remembers.
  struct Paused {
    PageId page;
    ScreenMemory memory;
  };

  ScreenTexts texts_;
  bool left_handed_;
  bool shown_ = false;
  ScreenState state_;
  ScreenMemory memory_;
  std::optional<Paused> paused_;
};

}  // namespace heft
