// A display is measured with a bank card, held against a rectangle that is made as large as it is.
#pragma once

#include "view/Window.h"

namespace heft {

/// As WindowModule says.
std::optional<MeasuredCard> measure_card(int display, const std::string& how);

}  // namespace heft
