// Whole sessions: started, resumed, aborted, or computed in memory.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "apparatus/LoggedSession.h"
#include "apparatus/configuration/ResolvedConfig.h"
#include "record/stream/EventSink.h"
#include "session/Runner.h"

namespace heft {

struct SessionRequest {
  ResolvedConfig config;
  std::string participant;
  std::string db = {};
  Purpose purpose = Purpose::main;  ///< of a person's session
  /// Known facts about the participant: their place in a study.
  std::map<std::string, std::string> participant_info = {};
  bool again = false;            ///< another session of a participant who finished this protocol
  std::string started_utc = {};  ///< empty: now
};

/// @throws Error if the path is a device, a pipe or a socket, because opening one may wait forever
///   or leave files beside it
void refuse_special_file(const std::string& db);

struct SessionResult {
  RunEnd end = RunEnd::finished;
  std::int64_t session_id = 0;
  double duration_s = 0;  ///< session time
  int n_completed = 0;
  std::string head;  ///< of the log, after the session; empty: left in a locked log
};

/// A new seed, 0...2^63-1, from the operating system.
std::uint64_t fresh_seed();

/// @throws Error (usage) if the participant has an unfinished session of the protocol, or a
///   finished one and `again` is not set; otherwise as Runner::run
SessionResult start_session(const SessionRequest& request, const RunnerOptions& runner);

/// The session of that id, or the newest unfinished one.
/// @throws Error if there is none, or it has ended
LoggedSession session_to_resume(const std::string& db, std::optional<std::int64_t> session_id);

/// Resumes an unfinished session: an open attempt becomes void ("interrupted") and is repeated with
/// the same draws. A changed configuration is logged first.
/// @param config resolved from the session's own
/// @throws Error (diverged) if the log was changed
SessionResult resume_session(const LoggedSession& session, const ResolvedConfig& config,
                             const RunnerOptions& runner);

/// Ends an unfinished session for good (state "aborted"), for participants who do not return.
/// Answers are kept; an open attempt becomes void.
void abort_session(const LoggedSession& session);

/// The `session` row that compute_session() would record.
SessionHeader header_of(const SessionRequest& request);

/// A simulated session that is kept in memory.
RecordedSession compute_session(const SessionRequest& request, const RunnerOptions& runner);

}  // namespace heft
