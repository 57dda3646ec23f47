// Whether the participant's texts fit their places: looks at every screen without a window.
#pragma once

#include <string>
#include <vector>

#include "experiment/ScreenTexts.h"
#include "view/screens/Page.h"

namespace heft {

/// The smallest screen that people are asked on: 1024 x 600, of 7".
Measures smallest_screen(double text_size = 1);

/// A sentence for each text that would be written much smaller than the rest, or that sticks out of
/// its place. Characters that no installed font has are as wide as the boxes that stand for them.
/// @return each sentence begins with the name of its page and ": "
std::vector<std::string> texts_that_do_not_fit(const ScreenTexts& texts, const Measures& measures);

}  // namespace heft
