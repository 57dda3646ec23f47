// What the participant's screen offers at a moment. Emitted by the engine, drawn by a view, read by
// a responder's mind. Nothing here tells a mass, a level, a condition or whether an answer was
// right.
// What a person does to the screen. Answers to the task are Actions; the rest turns pages. Times
// are those of the operating system's event, on the monotonic clock (base/Clock.h).
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
  declined,      ///< who does not agree to take part can take that back
  setting_up,    ///< before anything else, while the apparatus is looked at
  questionnaire  ///< `form` of the texts
};
template <>
struct EnumNames<Screen> {
  static constexpr std::array<std::string_view, 13> names{
      "consent",  "welcome",    "about_you",    "demonstration", "instructions",
      "trial",    "rest",       "paused",       "how_decided",   "thanks",
      "declined", "setting_up", "questionnaire"};
};

/// Which page it is: what is touched on one means nothing on another.
struct PageId {
  Screen screen = Screen::welcome;
  Task task = {};
  int trial_number = 0, attempt = 0, n_reshuffles = 0;
  std::string form = {};  ///< questionnaire: its name and what it is about

  bool operator==(const PageId&) const = default;
};

struct ScreenState {
  Screen screen = Screen::welcome;
  Task task = {};   ///< trial and instructions
  int n_slots = 0;  ///< trial only
  /// Trial: which one, so that the page of one is not taken for another's.
  int trial_number = 0, attempt = 0, n_reshuffles = 0;
  /// Trial: between two trials, how far what was there has faded, 0...1; the trial is the next one.
  std::optional<double> faded = {};
  /// Trial: the Offer of its task; empty: that of a trial without answers.
  std::any offer = {};
  bool can_answer = true;  ///< false until the cubes are there, and touched where that is asked for
  bool touch_first = false;  ///< trial: every cube is to be touched first, and not all of them were
  /// Trial: earlier answers, in seconds since its start, are refused; none: it takes any.
  std::optional<double> answers_from_s = {};
  bool can_validate = false;  ///< an answer in several steps (labels of all cubes) is complete
  bool try_again = false;     ///< the answer given last was wrong, and the task asks again
  int n_choices = 0;          ///< actions with a cube so far in this trial
  double wait_s = 0;          ///< pages: the button to go on appears in so many seconds
  std::map<std::string, std::string> entries = {};  ///< forms: what was answered before
  /// Questionnaire: its name, and what its entries' keys begin with ("sorting.nasa_tlx.").
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
