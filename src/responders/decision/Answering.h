// A finger on the touch screen: carries out an answer tap by tap, at human intervals, and only what
// the screen offers; finds out whether the answer was taken.
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
  /// @param tap_interval_s mean; taps are 0.3 s apart or more
  Answering(std::uint64_t seed, const TrialView& trial, double tap_interval_s);

  /// Starts to carry out an answer.
  /// @param first_tap_s time of its first action
  void give(const Answer& answer, double first_tap_s);

  /// Actions that fall between this frame and the next. Nothing while the trial is paused; what
  /// was due then comes after.
  std::vector<TimedAction> see(const DisplayedFrame& frame, const ScreenState& screen);

  /// No answer is under way: none given yet, or the last one was wrong or not taken.
  bool free() const { return free_; }
  /// Slots chosen wrongly so far, oldest first, where the task asks again.
  const std::vector<int>& wrong_slots() const { return wrong_slots_; }
  bool cubes_seen() const { return cubes_seen_; }
  /// Going on is pointless: several answers were not taken, or the cubes never appeared.
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
  std::optional<Action> last_;  // of an answer in steps, once the screen shows them complete
  double last_tap_s_ = 0;
  int n_choices_before_ = 0;
  std::optional<int> chosen_;
  std::vector<int> wrong_slots_;
  int n_refused_ = 0;
};

}  // namespace heft
