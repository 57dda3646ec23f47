// What a person does to the screen. Answers to the task are Actions; the rest turns pages. Times
// are those of the operating system's event, on the monotonic clock (base/Clock.h).
#pragma once

#include <string>

#include "experiment/Action.h"
#include "experiment/ScreenState.h"

namespace heft {

enum class TouchKind {
  action,          ///< an answer, in Touch::action (its t_s is not set)
  next,            ///< the page's button: start, continue
  decline,         ///< "I do not agree" on the consent page
  entry,           ///< a field of a form was set: key, value
  put_cubes_back,  ///< the button of that name
  close            ///< the window was closed
};

struct Touch {
  double monotonic_s = 0;
  TouchKind kind = TouchKind::action;
  Action action;
  std::string key, value;  ///< entry only
  PageId page = {};        ///< that it was on
};

}  // namespace heft
