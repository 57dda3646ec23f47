// The participant's screens: the page for a session's ScreenState, and the meaning of a tap on it.
// Independent of windows and events; WindowView displays the pages.
#pragma once

#include <limits>
#include <optional>

#include "experiment/ScreenState.h"
#include "experiment/ScreenTexts.h"
#include "view/screens/Page.h"
#include "view/screens/ScreenPages.h"
#include "view/text/Typeface.h"

namespace heft {

/// What has changed with the session's state.
enum class Turn {
  none,
  cubes,  ///< they appeared, so that answers are possible
  page    ///< a new page: the controls of the last one are gone
};

class Screens {
 public:
  Screens(ScreenTexts texts, bool left_handed)
      : texts_(std::move(texts)), left_handed_(left_handed) {}

  /// Sets the session's state.
  /// @param cubes_shown whether the scene has cubes, without which no answer is possible
  Turn show(const ScreenState& state, bool cubes_shown);

  /// The current page; empty until a state is set.
  /// @param up_s how long it has been displayed unchanged
  Page page(const Typeface& typeface, const Measures& measures,
            double up_s = std::numeric_limits<double>::infinity()) const;
  PageId page_id() const { return state_.page(); }

  /// The touch to report for a tap on a control of the page; none: the tap only changed the page.
  std::optional<Touch> tapped(const Control& control);

  const ScreenTexts& texts() const { return texts_; }

 private:
  Turn turn_to(const ScreenState& state, bool cubes_shown) const;
  void remember(const ScreenState& state);

  /// The state of a paused page.
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
