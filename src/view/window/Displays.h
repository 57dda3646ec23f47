// The displays of this machine, and whether people's sessions could be shown on them.
#pragma once

#include <vector>

#include "experiment/Check.h"
#include "experiment/DisplayFacts.h"
#include "experiment/ScreenTexts.h"

namespace heft {

/// All displays by number; none: there is no desktop.
std::vector<DisplayFacts> displays();

/// Displays, what draws on them, the typeface for these texts, touch: a line each.
std::vector<CheckResult> check_displays(const ScreenTexts& texts);

}  // namespace heft
