// The displays of this machine, and their suitability for sessions.
#pragma once

#include "view/Window.h"

namespace heft {

// Functions of WindowModule:
std::vector<DisplayFacts> displays();
std::vector<CheckResult> check_displays(const ScreenTexts& texts);

// Measures a display with a bank card, held against a rectangle that is adjusted to it.

/// See WindowModule.
std::optional<MeasuredCard> measure_card(int display, const std::string& how);

// Measures the time from a touch to its answer, as far as the computer can observe it.

/// See WindowModule.
std::vector<double> touch_delays_s(const ScreenTexts& texts, const std::function<void()>& keep,
                                   int n_taps);

}  // namespace heft
