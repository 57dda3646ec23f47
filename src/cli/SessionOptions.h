// What the commands that run sessions share: what a session is run with, Ctrl-C, progress, and what
// is said at the end.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apparatus/EventOutlet.h"
#include "apparatus/configuration/ResolvedConfig.h"
#include "cli/CommandLine.h"
#include "protocol/Protocol.h"

namespace heft {
struct RunnerOptions;
struct SessionResult;
}  // namespace heft

namespace heft::cli {

// The text of these options is read where the command line is, and nowhere else.

/// NAME or NAME:WHAT
Option add_plug(Command& command, const std::string& name, std::optional<Plug>& plug,
                const std::string& help);

/// human, NAME or NAME:FILE
Option add_responder(Command& command, std::optional<WhoAnswers>& responder,
                     const std::string& help);

/// One of an enumeration's names.
template <typename Enum>
Option add_choice(Command& command, const std::string& name, std::optional<Enum>& choice,
                  const std::string& help, const std::vector<std::string>& names) {
  // Another text is refused before it gets here.
  return command
      .add_option(name, ReadsText{[&choice](const std::string& text) { from_text(text, choice); }},
                  help)
      .one_of(names);
}

/// --camera-file, --board, --effector
void add_apparatus_options(Command& command, SessionOptions& given);

/// --set
void add_settings(Command& command, std::vector<ProtocolSetting>& settings,
                  const std::string& help);

/// --responder, --tracker, --view and those of the apparatus.
/// @param stay what is not given stays as the session has it; otherwise --help tells the defaults
void add_session_options(Command& command, SessionOptions& given, bool stay = false);

/// Says on stderr which calibration is taken where none was named.
void tell_camera_file(const SessionOptions& given, const SessionConfig& config);

/// Says on stderr what is known to be wrong with a simulator, if anything.
void warn_of_simulator(const std::string& name);

/// The same of the simulator that a session starts with, and the protocol's cautions; of `auto`,
/// which the options have resolved, what it is and why.
void tell_simulator(const ResolvedConfig& config);

/// What somebody should know before using a valid protocol, a sentence each; mostly nothing.
std::vector<std::string> cautions(const Protocol& protocol);

/// --backup, --events
void add_elsewhere_options(Command& command, std::string& backup,
                           std::optional<EventTarget>& events);

/// Puts a copy of the log there and says where, or loudly that there is none: that harms no
/// session, but somebody has to know it.
/// @param folder empty: none is wanted
void back_up_and_tell(const std::string& db, const std::string& folder, std::int64_t session_id);

/// How a session ended, and what comes next.
void say_finished(const SessionResult& result, const std::string& db);

struct CommandedSession {
  const ResolvedConfig& config;
  std::string db;
  bool unblind = false;
  bool go_on_unchecked = false;
  std::optional<EventTarget> events = {};
  std::string place = {};  ///< in a study, "7 of 24"
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
