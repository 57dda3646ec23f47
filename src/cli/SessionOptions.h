// What the commands that run sessions share: what a session is run with, Ctrl-C, progress, and what
// is said at the end.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apparatus/SessionSetup.h"
#include "cli/CommandLine.h"
#include "protocol/Protocol.h"

namespace heft {
struct RunnerOptions;
struct SessionResult;
}  // namespace heft

namespace heft::cli {

/// --camera-file, --board, --effector
void add_apparatus_options(Command& command, GivenOptions& given);

/// --set
void add_settings(Command& command, std::vector<std::string>& settings);

/// --responder, --tracker, --view and those of the apparatus.
/// @param stay what is not given stays as the session has it; otherwise --help tells the defaults
void add_session_options(Command& command, GivenOptions& given, bool stay = false);

/// A person is filmed and has a window; a model is neither unless somebody says so. Files of the
/// apparatus that are not given are the shipped ones; a real camera's calibration never is, it
/// stays empty.
SessionConfig with_defaults(const GivenOptions& given);

/// Completes the options, and says on stderr which calibration is taken where nobody named one.
/// @throws Error as complete()
void complete_and_tell(SessionConfig& options);

/// Says on stderr what is known to be wrong with a simulator, if anything.
void warn_of_simulator(const std::string& name);

/// The same of the simulator that a session starts with, and the protocol's cautions; of `auto`,
/// which the options have resolved, what it is and why.
void tell_simulator(const Protocol& protocol, const SessionConfig& options);

/// What somebody should know before using a valid protocol, a sentence each; mostly nothing.
std::vector<std::string> cautions(const Protocol& protocol);

/// A file of protocols/texts/ by its language, or any other by its path.
/// @throws Error (usage) naming the languages that there are
std::string texts_file(const std::string& language);

/// Where a session's events and copies go beside its log; empty: nowhere.
struct Elsewhere {
  std::string backup;  ///< folder
  std::string events;  ///< as EventOutlet takes it
};

/// The folder of a session's copies as its setup keeps it; empty stays that.
std::string backup_folder(const Elsewhere& elsewhere);

/// --backup, --events
void add_elsewhere_options(Command& command, Elsewhere& elsewhere);

/// Puts a copy of the log there and says where, or loudly that there is none: that harms no
/// session, but somebody has to know it.
/// @param folder empty: none is wanted
void back_up_and_tell(const std::string& db, const std::string& folder, std::int64_t session_id);

/// How a session ended, and what comes next.
void say_finished(const SessionResult& result, const std::string& db);

struct CommandedSession {
  const Protocol& protocol;
  const SessionConfig& setup;
  std::string db;
  bool unblind = false;
  bool go_on_unchecked = false;
  std::string events = {};  ///< as Elsewhere has it
  std::string place = {};   ///< in a study, "7 of 24"
};

/// --go-on
void add_go_on(Command& command, bool& go_on);

/// Runs `run` with Ctrl-C turned into a clean stop, and with a progress bar, or the experimenter's
/// console where the session keeps the time of day. Who declines to take part ends it as well. A
/// copy of the log is put to the setup's folder afterwards.
/// @throws Error before anything else when no copy could be put there; Error (interrupted) when
/// stopped, with how to go on; Error when the session paused itself
SessionResult run_session(const CommandedSession& session,
                          const std::function<SessionResult(const RunnerOptions&)>& run);

}  // namespace heft::cli
