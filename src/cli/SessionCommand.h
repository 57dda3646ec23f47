// What the commands that run sessions share: Ctrl-C, the progress bar, and what is said at the end.
#pragma once

#include <string>

#include "session/Session.h"

namespace heft::cli {

struct CommandedSession {
  const Protocol& protocol;
  const Setup& setup;
  std::string db;
  bool unblind = false;
};

/// Runs `run` with Ctrl-C turned into a clean stop, and with a progress bar, or the experimenter's
/// desk where the session keeps the time of day. Who declines to take part ends it as well.
/// @throws Error (interrupted) when stopped, with how to go on; Error when the session paused
/// itself
SessionResult run_session(const CommandedSession& session,
                          const std::function<SessionResult(const RunnerOptions&)>& run);

}  // namespace heft::cli
