// Something a participant does on the touch screen.
#pragma once

#include <optional>

#include "experiment/EventType.h"
#include "experiment/Task.h"

namespace heft {

struct Action {
  static constexpr EventType event_type{"action", EventRole::attempt};
  ActionKind kind = ActionKind::validate;
  std::optional<int> slot{};     ///< select, label, unlabel; from 1, leftmost
  std::optional<Label> label{};  ///< label only

  static void event_columns(auto& action, auto& row) {
    row.detail(action.kind).slot(action.slot).label(action.label);
  }
  bool operator==(const Action&) const = default;
};

/// An action with its time, seconds since the trial's start.
struct TimedAction : Action {
  double t_s = 0;
};

}  // namespace heft
