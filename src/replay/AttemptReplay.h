// One attempt's world run again from its logged effector poses.
#pragma once

#include <vector>

#include "apparatus/TrialWorld.h"
#include "protocol/Protocol.h"
#include "replay/Projection.h"

namespace heft {

class AttemptReplay {
 public:
  AttemptReplay(const Protocol& protocol, const AttemptFold& attempt);

  /// Runs the world to the next logged frame.
  ShownFrame advance(const FrameRow& frame);

  /// Lets go of what is still touched when the attempt ends.
  void finish(double ended_s);

  /// What the world said so far, in session time, as the runner logs it.
  const std::vector<Event>& derived() const { return derived_; }

 private:
  void fold_until(int n_events);

  const AttemptFold& attempt_;
  TrialWorld world_;
  std::size_t next_event_ = 0;
  int n_reshuffles_ = 0;
  std::vector<Event> derived_;
};

}  // namespace heft
