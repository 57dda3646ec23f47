// Displays a logged session: its frames as they were displayed, without the camera's pictures, and
// optionally the clone of a what-if simulation beside the logged one.
#pragma once

#include <atomic>

#include "replay/AttemptReplay.h"
#include "view/ArView.h"

namespace heft {

struct ReplayViewOptions {
  const Protocol* what_if = nullptr;  ///< whose clone is drawn, too; null: none
  bool in_real_time = false;          ///< at the frames' times; otherwise as fast as possible
  const std::atomic<bool>* stop = nullptr;
};

/// Presents every logged frame of the session's attempts.
/// @return number of frames
int show_session(const LogReader& reader, const LoggedSession& session, ArView& view,
                 const ReplayViewOptions& showing);

}  // namespace heft
