// The displays of this machine, and whether people's sessions could be shown on them.
#pragma once

#include "view/Window.h"

namespace heft {

// As WindowModule says.
std::vector<DisplayFacts> displays();
std::vector<CheckResult> check_displays(const ScreenTexts& texts);

}  // namespace heft
