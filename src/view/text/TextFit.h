// Checks that the participant's texts fit their places, on every screen, without a window.
#pragma once

#include <string>
#include <vector>

#include "experiment/ScreenTexts.h"
#include "view/screens/Page.h"

namespace heft {

/// The smallest supported screen: 1024 x 600, 7".
Measures smallest_screen(double text_size = 1);

/// One sentence for each text that would be much smaller than the others, or would extend beyond
/// its place. Characters that no installed font has count as wide as their replacement boxes.
/// @return each sentence begins with the name of its page and ": "
std::vector<std::string> texts_that_do_not_fit(const ScreenTexts& texts, const Measures& measures);

}  // namespace heft
