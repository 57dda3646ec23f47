// Whole sessions: start one, go on with one, or compute one in memory.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "apparatus/LoggedSession.h"
#include "apparatus/SessionSetup.h"
#include "record/RecordedSession.h"
#include "session/Runner.h"

namespace heft {

struct SessionRequest {
  Protocol protocol;
  SessionConfig setup;  ///< completed
  std::string participant;
  std::string db = "heft.db";
  std::uint64_t seed = 0;
  Purpose purpose = Purpose::main;  ///< of a person's session
  /// What is known of the participant beforehand: their place in a study.
  std::map<std::string, std::string> participant_info = {};
  bool again = false;  ///< one more session of a participant who finished this protocol
};

/// @throws Error when there is a device, a pipe or a socket where the log should be: opening one
///   could wait forever or leave files beside it
void refuse_special_file(const std::string& db);

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

/// The session of that id, or the newest unfinished one.
/// @throws Error when there is none, or it is over
LoggedSession session_to_resume(const std::string& db, std::optional<std::int64_t> session_id);

/// Puts them in force from here on and checks everything the session will run with.
/// @throws Error as complete(); Error (usage) for changes to the protocol, which a session has one
/// of
void change_setup(LoggedSession& session, const GivenOptions& again);

/// Goes on with an unfinished session: an attempt that was open is void ("interrupted") and runs
/// again with the same draws. A setup that is not the last one logged is told first.
/// @throws Error (diverged) when the log is not as it was written
SessionResult resume_session(const LoggedSession& session, const RunnerOptions& runner);

/// Ends an unfinished session for good (state "aborted"): somebody who will not come back. What was
/// answered stays; an attempt that was open is void.
void abort_session(const LoggedSession& session);

/// A simulated session that is kept in memory.
RecordedSession compute_session(const SessionRequest& request, const RunnerOptions& runner);

/// Where a session that goes on writes what it wrote to a file before: beside it. A video can't be
/// added to, and a recording must not be mixed with the one of before.
/// @return the path itself where nothing is there, else the first free one of "film-2.avi",
/// "film-3.avi"...
std::string next_part(const std::string& path);

/// The options with free paths for the view's video and the kept camera pictures.
SessionConfig with_next_parts(SessionConfig options);

}  // namespace heft
