// Something a participant does on the touch screen.
#pragma once

#include <optional>

#include "experiment/Task.h"

namespace heft {

struct Action {
  double t_s = 0;  ///< seconds; since the trial's start between responder and runner
  ActionKind kind = ActionKind::validate;
  std::optional<int> slot;     ///< select, label, unlabel; from 1, leftmost
  std::optional<Label> label;  ///< label only
};

}  // namespace heft
