// What the commands that run sessions share: Ctrl-C, the progress bar, and what is said at the end.
#pragma once

#include <string>

#include "session/Session.h"

namespace heft::cli {

/// Runs `run` with Ctrl-C turned into a clean stop and a progress bar.
/// @throws Error (interrupted) when stopped, with how to go on; Error when the session paused
/// itself
SessionResult run_session(const Protocol& protocol, const std::string& db,
                          const std::function<SessionResult(const RunnerOptions&)>& run);

}  // namespace heft::cli
