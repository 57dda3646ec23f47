#include <algorithm>

#include "base/Clock.h"
#include "replay/AttemptReplay.h"
#include "replay/Replay.h"

namespace heft {

namespace {
// Keeps a view with a screen responsive while waiting.
constexpr double longest_wait_s = 0.02;

class Show {
 public:
  Show(ArView& view, const ReplayViewOptions& showing) : view_(view), showing_(showing) {}

  void attempt(const AttemptFold& attempt, const std::vector<FrameRow>& frames) {
    const double start_s = monotonic_s();
    std::optional<AttemptReplay> what_if;
    if (showing_.what_if) what_if.emplace(*showing_.what_if, attempt);
    for (const FrameRow& frame : frames) {
      ViewFrame shown;
      shown.frame = displayed(frame);
      if (what_if) shown.other_clone = what_if->advance(frame).frame.clone;
      wait_until(start_s + frame.trial_t_s);
      if (stopped()) return;
      view_.present(shown, screen_of(attempt.first_plan));
      ++n_shown_;
    }
  }

  bool stopped() const { return showing_.stop && *showing_.stop; }
  int n_shown() const { return n_shown_; }

 private:
  static ScreenState screen_of(const TrialPlan& plan) {
    ScreenState screen;
    screen.screen = Screen::trial;
    screen.task = plan.task;
    screen.n_slots = plan.n_slots();
    return screen;
  }

  void wait_until(double t_s) {
    while (showing_.in_real_time && !stopped() && monotonic_s() < t_s)
      view_.wait(std::clamp(t_s - monotonic_s(), 0.0, longest_wait_s));
  }

  ArView& view_;
  const ReplayViewOptions& showing_;
  int n_shown_ = 0;
};
}  // namespace

int show_session(const LogReader& reader, const LoggedSession& session, ArView& view,
                 const ReplayViewOptions& showing) {
  const Projection fold = sound_fold(reader, session);
  Show show(view, showing);
  for (const auto& [index, attempt] : fold.attempts) {
    if (show.stopped()) break;
    show.attempt(attempt, reader.frames(session.row.session_id, index));
  }
  return show.n_shown();
}

}  // namespace heft
