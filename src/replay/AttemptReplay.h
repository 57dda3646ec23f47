// Logged attempts: the frames that a viewer saw, and their world run again from the logged effector
// poses.
#pragma once

#include <vector>

#include "apparatus/LoggedSession.h"
#include "apparatus/TrialWorld.h"
#include "protocol/Protocol.h"
#include "replay/Projection.h"

namespace heft {

class AttemptReplay {
 public:
  AttemptReplay(const Protocol& protocol, const ProjectedAttempt& attempt);

  /// Advances the world to the next logged frame.
  ShownFrame advance(const FrameRow& frame);

  /// Ends the current contacts at the attempt's end.
  void finish(double ended_s);

  /// The world's events so far, in session time, as the runner logs them.
  const std::vector<Event>& derived() const { return derived_; }

 private:
  void fold_until(int n_events);

  const ProjectedAttempt& attempt_;
  TrialWorld world_;
  std::size_t next_event_ = 0;
  int n_reshuffles_ = 0;
  std::vector<Event> derived_;
};

/// The displayed frame of a row.
DisplayedFrame displayed(const FrameRow& row);

/// The folded session, after its digests and events have been verified.
/// @throws Error (diverged) naming the first fault
Projection sound_fold(const LogReader& reader, const LoggedSession& session);

/// The attempt's frames up to an event of its session (counted from 0), without those hidden by a
/// pause's page.
std::vector<DisplayedFrame> seen_frames(const ProjectedAttempt& attempt,
                                        const std::vector<FrameRow>& rows, int up_to_event);

}  // namespace heft
