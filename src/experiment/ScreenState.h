// What the participant's screen offers at a moment. Emitted by the engine, drawn by a view, read by
// a responder's mind. Nothing here tells a mass, a level, a condition or whether an answer was
// right.
#pragma once

#include <optional>
#include <vector>

#include "experiment/Task.h"

namespace heft {

enum class Screen {
  consent,
  welcome,
  about_you,
  demonstration,
  instructions,  ///< before a block of trials of `task`
  trial,
  rest,
  paused,
  how_decided,
  thanks,
  setting_up  ///< before anything else, while the apparatus is looked at
};
template <>
struct EnumNames<Screen> {
  static constexpr std::array<std::string_view, 11> names{
      "consent", "welcome", "about_you",   "demonstration", "instructions", "trial",
      "rest",    "paused",  "how_decided", "thanks",        "setting_up"};
};

struct ScreenState {
  Screen screen = Screen::welcome;
  Task task = Task::sorting;                      ///< trial and instructions
  int n_slots = 0;                                ///< trial only
  std::vector<std::optional<Label>> labels = {};  ///< sorting: given so far, by slot
  bool can_answer = true;  ///< false until all that must be done first is done (touch every cube)
  bool can_validate = false;  ///< sorting: every cube has a label
  bool try_again = false;     ///< introduction: the cube chosen last was not the heaviest
  int n_choices = 0;          ///< select, label and unlabel actions so far in this trial
  double wait_s = 0;          ///< pages: the button to go on appears in so many seconds
};

}  // namespace heft
