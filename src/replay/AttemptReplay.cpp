#include "replay/AttemptReplay.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/Error.h"
#include "record/schema/EventRow.h"

namespace heft {

AttemptReplay::AttemptReplay(const Protocol& protocol, const ProjectedAttempt& attempt)
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
  // The runner logs cubes_shown after the other events of the frame.
  std::stable_partition(shown.events.begin(), shown.events.end(),
                        [](const Event& e) { return !e.as<CubesShown>(); });
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

DisplayedFrame displayed(const FrameRow& row) {
  return {row.trial_t_s, row.tracked, row.effector, row.clone, row.cubes};
}

Projection sound_fold(const LogReader& reader, const LoggedSession& session) {
  const std::int64_t id = session.row.session_id;
  const auto fault = [&](const std::string& what) {
    return Error(
        fmt::format("session {} of {}: the log was changed, at {}; nothing is computed from it. "
                    "Inspect it with: heft replay --db FILE --session {}",
                    id, session.db, what, id),
        ExitCode::diverged);
  };
  if (const auto broken = reader.first_broken_digest(id)) throw fault(broken->row);
  Projection fold = fold_session(session.protocol, session.row.header.seed, reader.events(id));
  if (fold.refused)
    throw fault(fmt::format("its event {}: {}", fold.n_events + 1, fold.refused->second));
  return fold;
}

std::vector<DisplayedFrame> seen_frames(const ProjectedAttempt& attempt,
                                        const std::vector<FrameRow>& rows, int up_to_event) {
  std::vector<DisplayedFrame> seen;
  auto event = attempt.events.begin();
  bool paused = false;
  for (const FrameRow& row : rows) {
    if (row.after_event > up_to_event) break;
    for (; event != attempt.events.end() && event->before < row.after_event; ++event) {
      if (event->event.as<SessionPaused>()) paused = true;
      if (event->event.as<SessionContinued>()) paused = false;
    }
    if (!paused) seen.push_back(displayed(row));
  }
  return seen;
}

}  // namespace heft
