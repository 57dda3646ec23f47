// The participant's display, from outside: all that asks the window system for anything is in the
// room `window`. SDL brings some forty shared libraries along, which only people's sessions need;
// so that room is a module by itself, loaded by whoever asks first.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiment/EventPayloads.h"
#include "experiment/ScreenTexts.h"
#include "experiment/Stage.h"
#include "view/ArView.h"

namespace heft {

/// A bank card, which is as large everywhere (ISO/IEC 7810 ID-1).
inline constexpr double card_w_mm = 85.60, card_h_mm = 53.98;

struct MeasuredCard {
  DisplayFacts display;
  double w_px = 0;  ///< the card's, on it
};

/// What the module has.
struct WindowModule {
  /// @throws Error (device_missing) without a display, (invalid_file) when no installed font has a
  /// character of the texts
  std::unique_ptr<ArView> (*make)(const ViewSetup& setup);

  /// All displays by number; none: there is no desktop.
  std::vector<DisplayFacts> (*displays)();

  /// Displays, what draws on them, the typeface for these texts, touch: a line each.
  std::vector<CheckResult> (*check_displays)(const ScreenTexts& texts);

  /// Shows a rectangle, which is made as large as a bank card, below the words, full screen. The
  /// wheel and the arrow keys change it by a pixel (with Shift ten), dragging the mouse makes it as
  /// wide; Enter ends it, Escape without a result.
  /// @throws Error (device_missing) when there is no such display
  std::optional<MeasuredCard> (*measure_card)(int display, const std::string& how);

  /// Opens a window for a few seconds, taps in it, and times each tap from the window system's
  /// event until the frame that answers it is presented, on the way that a session's taps go. What
  /// the touch screen takes before that event, and the panel after that frame, is not in it.
  /// @param keep what is done with each tap before that frame, as a session puts it on disk
  /// @return seconds, a tap each; those that the window did not take are not among them
  /// @throws Error as make
  std::vector<double> (*touch_delays_s)(const ScreenTexts& texts, const std::function<void()>& keep,
                                        int n_taps);
};

/// @throws Error naming the module and what is wrong with it, if it can't be loaded
const WindowModule& window_module();

}  // namespace heft
