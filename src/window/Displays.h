// The displays of this machine, and whether people's sessions could be shown on them.
#pragma once

#include "view/Window.h"

namespace heft {

// As WindowModule says.
std::vector<DisplayFacts> displays();
std::vector<CheckResult> check_displays(const ScreenTexts& texts);

// A display is measured with a bank card, held against a rectangle that is made as large as it is.

/// As WindowModule says.
std::optional<MeasuredCard> measure_card(int display, const std::string& how);

// How long people wait for the answer to a touch, as far as that is known without looking at the
// display itself.

/// As WindowModule says.
std::vector<double> touch_delays_s(const ScreenTexts& texts, const std::function<void()>& keep,
                                   int n_taps);

}  // namespace heft
