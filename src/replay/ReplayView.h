// A logged session shown again: its frames as they were displayed, without the camera's pictures,
// and the clone of a what-if beside the logged one.
#pragma once

#include <atomic>

#include "replay/AttemptReplay.h"
#include "view/ArView.h"

namespace heft {

struct ReplayViewOptions {
  const Protocol* what_if = nullptr;  ///< whose clone is drawn too; null: none
  bool in_real_time = false;          ///< frames at their times; otherwise one after the other
  const std::atomic<bool>* stop = nullptr;
};

/// Presents every logged frame of the session's attempts.
/// @return how many
int show_session(const LogReader& reader, const LoggedSession& session, ArView& view,
                 const ReplayViewOptions& showing);

}  // namespace heft
