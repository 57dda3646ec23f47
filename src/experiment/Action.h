// Something a participant does on the touch screen. A task's declaration (src/tasks) says which
// kinds it has and which of the other columns each fills.
#pragma once

#include <optional>

#include "experiment/EventType.h"
#include "experiment/Task.h"

namespace heft {

struct Action {
  static constexpr EventType event_type{"action", EventRole::attempt};
  ActionKind kind{};
  std::optional<int> slot{};  ///< the cube that it is about, from 1, leftmost
  std::optional<Label> label{};
  std::optional<double> value{};

  static void event_columns(auto& action, auto& row) {
    row.detail(action.kind).slot(action.slot).label(action.label).number(action.value);
  }
  bool operator==(const Action&) const = default;
};

/// An action with its time, seconds since the trial's start.
struct TimedAction : Action {
  double t_s = 0;
};

}  // namespace heft
