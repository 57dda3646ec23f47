#include "responders/decision/Answering.h"

#include <algorithm>
#include <array>
#include <utility>

#include "responders/Responder.h"

namespace heft {

namespace {
// An answer without effect for this long was refused.
constexpr double patience_s = 2;
constexpr double least_interval_s = 0.3;
constexpr int most_refused = 3;
// Cubes that have not appeared by then never will: the hand rests in their places.
constexpr double waits_for_cubes_s = 60;
}  // namespace

Answering::Answering(std::uint64_t seed, const TrialView& trial, double tap_interval_s)
    : frame_interval_s_(1 / trial.stage.display_rate_hz),
      tap_interval_s_(tap_interval_s),
      stream_(trial_stream(seed, "taps", trial)) {}

bool Answering::gave_up(double t_s) const {
  return n_refused_ >= most_refused || (!cubes_seen_ && t_s > waits_for_cubes_s);
}

double Answering::interval_s() {
  return std::max(least_interval_s, tap_interval_s_ * (0.7 + 0.6 * stream_.uniform()));
}

void Answering::give(const Answer& answer, double first_tap_s) {
  if (answer.actions.empty()) return;
  free_ = false;
  std::vector<Action> steps = answer.actions;
  const Action last = steps.back();
  chosen_ = last.slot;
  steps.pop_back();
  if (steps.empty()) return queue_.push_back({last, first_tap_s});
  last_ = last;
  stream_.shuffle(std::span(steps));
  double t_s = first_tap_s;
  const auto tap = [&](const Action& action) {
    queue_.push_back({action, t_s});
    t_s += interval_s();
  };
  if (answer.first_step_corrected)
    tap({steps.front().kind, steps.front().slot, steps.back().label});
  for (const Action& step : steps) tap(step);
}

std::vector<TimedAction> Answering::see(const DisplayedFrame& frame, const ScreenState& screen) {
  cubes_seen_ = cubes_seen_ || !frame.cubes.empty();
  if (screen.screen != Screen::trial || free_) {
    last_tap_s_ = std::max(last_tap_s_, frame.t_s);  // the patience timer restarts after a pause
    return {};
  }
  if (queue_.empty()) look_for_outcome(frame.t_s, screen);
  return due(frame.t_s, screen);
}

void Answering::look_for_outcome(double t_s, const ScreenState& screen) {
  if (last_ && screen.can_validate) {
    queue_.push_back({*last_, last_tap_s_ + interval_s()});
    last_.reset();
  } else if (screen.try_again && screen.n_choices > n_choices_before_) {
    if (chosen_) wrong_slots_.push_back(*chosen_);
    free_ = true;
  } else if (t_s > last_tap_s_ + patience_s) {
    ++n_refused_;
    free_ = true;
  }
}

std::vector<TimedAction> Answering::due(double t_s, const ScreenState& screen) {
  // Delayed taps are shifted together, so that their intervals remain.
  const double earliest_s = std::max(t_s, screen.answers_from_s.value_or(t_s));
  const double late_s = queue_.empty() ? 0 : std::max(0.0, earliest_s - queue_.front().t_s);
  for (TimedAction& action : queue_) action.t_s += late_s;
  std::vector<TimedAction> actions;
  while (!queue_.empty() && queue_.front().t_s < t_s + frame_interval_s_) {
    last_tap_s_ = queue_.front().t_s;
    n_choices_before_ = screen.n_choices;
    actions.push_back(std::exchange(queue_.front(), {}));
    queue_.pop_front();
  }
  return actions;
}

}  // namespace heft
