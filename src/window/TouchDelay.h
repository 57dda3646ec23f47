// How long people wait for the answer to a touch, as far as that is known without looking at the
// display itself.
#pragma once

#include "view/Window.h"

namespace heft {

/// As WindowModule says.
std::vector<double> touch_delays_s(const ScreenTexts& texts, const std::function<void()>& keep,
                                   int n_taps);

}  // namespace heft
