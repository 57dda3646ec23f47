// A finger on the touch screen: carries out an answer tap by tap, at human intervals, using only
// what the screen offers, and detects whether the answer was accepted.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "base/Random.h"
#include "experiment/EventPayloads.h"
#include "experiment/ScreenState.h"
#include "experiment/Stage.h"
#include "responders/Responder.h"

namespace heft {

class Answering {
 public:
  /// @param tap_interval_s mean; at least 0.3 s between taps
  Answering(std::uint64_t seed, const TrialView& trial, double tap_interval_s);

  /// Starts to carry out an answer.
  /// @param first_tap_s time of its first action
  void give(const Answer& answer, double first_tap_s);

  /// Actions between this frame and the next. None while the trial is paused; delayed ones follow
  /// afterwards.
  std::vector<TimedAction> see(const DisplayedFrame& frame, const ScreenState& screen);

  /// Whether no answer is in progress: none given yet, or the last one was wrong or refused.
  bool free() const { return free_; }
  /// Slots of incorrect choices so far, oldest first, if the task asks again.
  const std::vector<int>& wrong_slots() const { return wrong_slots_; }
  bool cubes_seen() const { return cubes_seen_; }
  /// Whether to give up: several answers were refused, or the cubes never appeared.
  bool gave_up(double t_s) const;

 private:
  void look_for_outcome(double t_s, const ScreenState& screen);
  std::vector<TimedAction> due(double t_s, const ScreenState& screen);
  double interval_s();

  double frame_interval_s_;
  double tap_interval_s_;
  RandomStream stream_;
  bool cubes_seen_ = false;
  bool free_ = true;
  std::deque<TimedAction> queue_;
  std::optional<Action> last_;  // last step of an answer, given once the screen shows the others
  double last_tap_s_ = 0;
  int n_choices_before_ = 0;
  std::optional<int> chosen_;
  std::vector<int> wrong_slots_;
  int n_refused_ = 0;
};

}  // namespace heft
