// What the participant's screen offers, and the touches on it. The engine emits a screen state, a
// view draws it, a responder reads it. It reveals no mass, level, condition or correctness.
#pragma once

#include <any>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiment/EventPayloads.h"
#include "experiment/TrialPlan.h"

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
  declined,      ///< consent was declined; the participant can take that back
  setting_up,    ///< first, while the apparatus is checked
  questionnaire  ///< `form` of the texts
};
template <>
struct EnumNames<Screen> {
  static constexpr std::array<std::string_view, 13> names{
      "consent",  "welcome",    "about_you",    "demonstration", "instructions",
      "trial",    "rest",       "paused",       "how_decided",   "thanks",
      "declined", "setting_up", "questionnaire"};
};

/// Identifies a page, so that a touch on one page is not taken for a touch on another.
struct PageId {
  Screen screen = Screen::welcome;
  Task task = {};
  int trial_number = 0, attempt = 0, n_reshuffles = 0;
  std::string form = {};  ///< questionnaire: ScreenState::form_prefix

  bool operator==(const PageId&) const = default;
};

struct ScreenState {
  Screen screen = Screen::welcome;
  Task task = {};            ///< trial and instructions
  std::string wording = {};  ///< instructions: TaskDeclaration::wordings; empty: the usual one
  int n_slots = 0;           ///< trial only
  int trial_number = 0, attempt = 0, n_reshuffles = 0;  ///< trial only
  /// Between two trials, how far the last trial's scene has faded out, 0...1.
  std::optional<double> faded = {};
  /// In practice, before the next trial: whether the last answer was correct.
  std::optional<bool> feedback = {};
  /// Trial: the task's Offer; empty: its default.
  std::any offer = {};
  bool can_answer = true;    ///< false before the cubes are shown or while touch_first holds
  bool touch_first = false;  ///< every cube must be touched first, and one was not yet
  /// Answers before this time, seconds since the trial's start, are refused; none: no limit.
  std::optional<double> answers_from_s = {};
  bool can_validate = false;  ///< an answer of several steps (labels of all cubes) is complete
  bool is_check = false;      ///< trial: no one answers, the display is measured
  bool try_again = false;     ///< the task asks again: the last answer was wrong, or a step
  int n_choices = 0;          ///< actions on cubes so far in this trial
  double wait_s = 0;          ///< pages: time until the button to continue appears
  std::map<std::string, std::string> entries = {};  ///< forms: earlier answers
  /// Questionnaire: its name, and the prefix of its entries' keys ("sorting.nasa_tlx.").
  std::string form = {}, form_prefix = {};

  PageId page() const {
    const bool of_trial = screen == Screen::trial;
    return {screen,
            task,
            of_trial ? trial_number : 0,
            of_trial ? attempt : 0,
            of_trial ? n_reshuffles : 0,
            form_prefix};
  }
};

enum class TouchKind {
  action,          ///< an answer, in Touch::action (its t_s is not set)
  next,            ///< the page's button (start, continue)
  decline,         ///< "I do not agree" on the consent page
  entry,           ///< a field of a form was set: key, value
  put_cubes_back,  ///< the button that resets the cubes
  close            ///< the window was closed
};

/// A touch on the screen. Its time is that of the operating system's event (base/Clock.h).
struct Touch {
  double monotonic_s = 0;
  TouchKind kind = TouchKind::action;
  Action action;
  std::string key, value;  ///< entry only
  PageId page = {};        ///< the page that was touched
};

}  // namespace heft
