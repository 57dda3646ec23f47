#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "base/Clock.h"
#include "replay/AttemptReplay.h"
#include "replay/Replay.h"

namespace heft {

namespace {
// Keeps a view with a screen responsive while waiting.
constexpr double longest_wait_s = 0.02;
// A trial's last frame precedes the answer that ends it: it shows that answer, too.
constexpr double answer_shown_s = 0.1;

class Show {
 public:
  Show(ArView& view, const ReplayViewOptions& showing) : view_(view), showing_(showing) {}

  void attempt(const ProjectedAttempt& attempt, const std::vector<FrameRow>& frames) {
    const double start_s = monotonic_s();
    std::optional<AttemptReplay> what_if;
    if (showing_.what_if) what_if.emplace(*showing_.what_if, attempt);
    for (const FrameRow& frame : frames) {
      ViewFrame shown;
      shown.frame = displayed(frame);
      if (what_if) shown.other_clone = what_if->advance(frame).frame.clone;
      shown.captions = captions(attempt, frame.trial_t_s);
      wait_until(start_s + frame.trial_t_s);
      if (stopped()) return;
      view_.present(shown, screen_of(attempt.first_plan));
      ++n_shown_;
    }
  }

  bool stopped() const { return showing_.stop && *showing_.stop; }
  int n_shown() const { return n_shown_; }

 private:
  // As many as replay_captions.
  std::vector<std::string> captions(const ProjectedAttempt& attempt, double t_s) const {
    const TrialRow& row = attempt.row;
    const char* legend = showing_.what_if
                             ? "blue: clone; violet outline: clone with the changes; gray: effector"
                             : "blue: clone; gray: effector; yellow: cubes";
    const std::string again =
        row.plan.attempt > 1 ? fmt::format(", attempt {}", row.plan.attempt) : "";
    return {fmt::format("trial {}{}: {}, {}; left to right {:g} g; {:.1f} s", row.plan.trial_number,
                        again, row.plan.task, row.plan.condition,
                        fmt::join(masses_at(attempt, row.started_s + t_s), ", "), t_s),
            answers_until(attempt, row.started_s + t_s), legend};
  }

  // By slot, also after the cubes were shuffled again.
  static std::vector<double> masses_at(const ProjectedAttempt& attempt, double until_s) {
    std::vector<double> masses_g = attempt.first_plan.masses_g;
    for (const AttemptEvent& logged : attempt.events)
      if (logged.event.t_s <= until_s && logged.plan_after.n_reshuffles > 0)
        masses_g = logged.plan_after.masses_g;
    return masses_g;
  }

  // The answers until then, each label once; the outcome at the end.
  static std::string answers_until(const ProjectedAttempt& attempt, double until_s) {
    std::map<int, std::string> labels;
    std::string last;
    for (const AttemptEvent& logged : attempt.events) {
      const auto* action = logged.event.as<Action>();
      if (!action || logged.event.t_s > until_s + answer_shown_s) continue;
      if (action->label && action->slot) labels[*action->slot] = *action->label;
      if (action->kind == "unlabel" && action->slot) labels.erase(*action->slot);
      if (action->label || action->kind == "unlabel") continue;
      last = action->kind;
      if (action->slot) last += fmt::format(" cube {}", *action->slot);
      if (action->value) last += fmt::format(" {:g}", *action->value);
    }
    std::vector<std::string> all;
    for (const auto& [slot, label] : labels) all.push_back(fmt::format("cube {} {}", slot, label));
    if (!last.empty()) all.push_back(last);
    std::string text = fmt::format(
        "answer: {}", all.empty() ? "none yet" : fmt::format("{}", fmt::join(all, "; ")));
    const TrialRow& row = attempt.row;
    const bool over = row.ended_s && *row.ended_s <= until_s + answer_shown_s;
    if (over && row.outcome) text += fmt::format(" ({})", *row.outcome);
    return text;
  }

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
