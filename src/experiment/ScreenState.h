// What the participant's screen offers at a moment. Emitted by the engine, drawn by a view, read by
// a responder's mind. Nothing here tells a mass, a level, a condition or whether an answer was
// right.
#pragma once

#include <optional>
#include <vector>

#include "experiment/Task.h"

namespace heft {

enum class Screen { welcome, demonstration, trial, rest, paused, thanks };

struct ScreenState {
  Screen screen = Screen::welcome;
  Task task = Task::sorting;                 ///< trial only
  std::vector<std::optional<Label>> labels;  ///< sorting: given so far, by slot
  bool can_answer = true;  ///< false until all that must be done first is done (touch every cube)
  bool can_validate = false;  ///< sorting: all three labels are given
  bool try_again = false;     ///< introduction: the cube chosen last was not the heaviest
  int n_choices = 0;          ///< select, label and unlabel actions so far in this trial
};

}  // namespace heft
