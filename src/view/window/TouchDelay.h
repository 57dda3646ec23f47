// How long people wait for the answer to a touch, as far as that is known without looking at the
// display itself.
#pragma once

#include <functional>
#include <vector>

#include "experiment/ScreenTexts.h"

namespace heft {

/// Opens a window for a few seconds, taps in it, and times each tap from the window system's event
/// until the frame that answers it is presented, on the way that a session's taps go. What the
/// touch screen takes before that event, and the panel after that frame, is not in it.
/// @param keep what is done with each tap before that frame, as a session puts it on disk
/// @return seconds, a tap each; those that the window did not take are not among them
/// @throws Error as WindowView
std::vector<double> touch_delays_s(const ScreenTexts& texts, const std::function<void()>& keep,
                                   int n_taps);

}  // namespace heft
