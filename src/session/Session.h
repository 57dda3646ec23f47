// Whole sessions: start one, go on with one, or compute one in memory.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "record/LogReader.h"
#include "record/RecordedSession.h"
#include "session/RunOptions.h"
#include "session/Runner.h"

namespace heft {

struct SessionRequest {
  Protocol protocol;
  RunOptions options;  ///< completed
  std::string participant;
  std::string db = "heft.db";
  std::uint64_t seed = 0;
  bool again = false;  ///< one more session of a participant who finished this protocol
};

struct SessionResult {
  RunEnd end = RunEnd::finished;
  std::int64_t session_id = 0;
  double duration_s = 0;  ///< session time
  int n_completed = 0;
};

/// A fresh seed, 0...2^63-1, from the operating system.
std::uint64_t fresh_seed();

/// @throws Error (usage) when the participant has an unfinished session of the protocol, or a
///   finished one and `again` is not set; otherwise as Runner::run
SessionResult start_session(const SessionRequest& request, const RunnerOptions& runner);

/// A logged session with what it is run with, from the log alone.
struct LoggedSession {
  std::string db;
  SessionRow row;
  RunOptions options;
  std::shared_ptr<const Protocol> protocol;
};

/// @throws Error when there is no such session, or its protocol or options can't be read
LoggedSession load_session(const LogReader& reader, const std::string& db, std::int64_t session_id);

/// The session of that id, or the newest unfinished one.
/// @throws Error when there is none, or it is over
LoggedSession session_to_resume(const std::string& db, std::optional<std::int64_t> session_id);

/// Goes on with an unfinished session: an attempt that was open is void ("interrupted") and runs
/// again with the same draws.
SessionResult resume_session(const LoggedSession& session, const RunnerOptions& runner);

/// A simulated session that is kept in memory.
RecordedSession compute_session(const SessionRequest& request, const RunnerOptions& runner);

/// The `session` row of a request that starts now.
SessionHeader header_of(const SessionRequest& request);

}  // namespace heft
