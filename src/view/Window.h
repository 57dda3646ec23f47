// Interface of the folder `window`, the only one that uses the window system. SDL needs some forty
// shared libraries, which only sessions with a window use, so that the folder is a module loaded on
// first use.
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

/// A bank card, a common object of standardized size (ISO/IEC 7810 ID-1).
inline constexpr double card_w_mm = 85.60, card_h_mm = 53.98;

struct MeasuredCard {
  DisplayFacts display;
  double w_px = 0;  ///< width of the card on the display
};

/// Functions of the module.
struct WindowModule {
  /// @throws Error (device_missing) without a display, (invalid_file) if no installed font has a
  ///   character of the texts
  std::unique_ptr<ArView> (*make)(const ViewSetup& setup);

  /// All displays by number; none: there is no desktop.
  std::vector<DisplayFacts> (*displays)();

  /// Checks displays, graphics, the typeface for these texts, and touch: one result each.
  std::vector<CheckResult> (*check_displays)(const ScreenTexts& texts);

  /// Shows a rectangle below the text, full screen, to be adjusted to the size of a bank card: by
  /// the wheel and the arrow keys a pixel at a time (ten with Shift), by dragging the mouse. Enter
  /// accepts, Escape returns no result.
  /// @throws Error (device_missing) if that display is missing
  std::optional<MeasuredCard> (*measure_card)(int display, const std::string& how);

  /// Opens a window for a few seconds, taps in it, and measures the time from the window system's
  /// event of each tap until the frame with its answer is presented, processed as in a session. The
  /// delays of the touch screen before and of the panel after are not included.
  /// @param keep called with each tap before that frame, as a session writes it to disk
  /// @return seconds for each tap that the window received
  /// @throws Error as make
  std::vector<double> (*touch_delays_s)(const ScreenTexts& texts, const std::function<void()>& keep,
                                        int n_taps);
};

/// @throws Error naming the module and the reason if it cannot be loaded
const WindowModule& window_module();

}  // namespace heft
