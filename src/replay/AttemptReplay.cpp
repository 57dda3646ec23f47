#include "replay/AttemptReplay.h"

#include <algorithm>

namespace heft {

AttemptReplay::AttemptReplay(const Protocol& protocol, const AttemptFold& attempt)
    : attempt_(attempt), world_(protocol, attempt.first_plan) {}

ShownFrame AttemptReplay::advance(const FrameRow& frame) {
  fold_until(frame.after_event);
  TargetSample sample;
  sample.t_capture_s = frame.trial_t_s;
  sample.pose = frame.effector;
  sample.velocity = frame.effector_velocity;
  sample.tracked = frame.tracked;
  sample.jump = frame.jump;
  ShownFrame shown = world_.advance(sample);
  // As the runner logs them: the cubes are shown once everything else of the frame is told.
  std::ranges::stable_partition(shown.events, [](const Event& e) { return !e.as<CubesShown>(); });
  for (Event event : shown.events) {
    event.t_s += attempt_.row.started_s;
    derived_.push_back(event);
  }
  return shown;
}

void AttemptReplay::fold_until(int n_events) {
  for (; next_event_ < attempt_.events.size() && attempt_.events[next_event_].before < n_events;
       ++next_event_) {
    const AttemptEvent& folded = attempt_.events[next_event_];
    if (const auto* reset = folded.event.as<CubesReset>(); reset && !reset->slot)
      world_.request_reset();
    if (folded.plan_after.n_reshuffles > n_reshuffles_) {
      n_reshuffles_ = folded.plan_after.n_reshuffles;
      world_.rearrange(folded.plan_after);
    }
  }
}

void AttemptReplay::finish(double ended_s) {
  for (Event event : world_.end_contacts(ended_s - attempt_.row.started_s)) {
    event.t_s += attempt_.row.started_s;
    derived_.push_back(event);
  }
}

}  // namespace heft
