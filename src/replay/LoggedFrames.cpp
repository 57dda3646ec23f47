#include "replay/LoggedFrames.h"

#include <fmt/format.h>

#include "base/Error.h"
#include "record/schema/EventRow.h"

namespace heft {

DisplayedFrame displayed(const FrameRow& row) {
  return {row.trial_t_s, row.tracked, row.effector, row.clone, row.cubes};
}

Projection sound_fold(const LogReader& reader, const LoggedSession& session) {
  const std::int64_t id = session.row.session_id;
  const auto fault = [&](const std::string& what) {
    return Error(
        fmt::format("session {} of {} is not as it was written, at {}; nothing is computed "
                    "from it. heft replay --db FILE --session {} says more",
                    id, session.db, what, id),
        ExitCode::diverged);
  };
  if (const auto broken = reader.first_broken_digest(id)) throw fault(broken->row);
  Projection fold = fold_session(session.protocol, session.row.header.seed, reader.events(id));
  if (fold.refused)
    throw fault(fmt::format("its event {}: {}", fold.n_events + 1, fold.refused->second));
  return fold;
}

std::vector<DisplayedFrame> seen_frames(const AttemptFold& attempt,
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
