// Common to the commands that run sessions: configuration options, Ctrl-C, progress, and the final
// messages.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apparatus/EventOutlet.h"
#include "apparatus/configuration/ResolvedConfig.h"
#include "cli/CommandLine.h"
#include "protocol/Protocol.h"
#include "record/reader/LogReader.h"

namespace heft {
struct RunnerOptions;
struct SessionResult;
}  // namespace heft

namespace heft::cli {

// The text of these options is parsed on the command line only.

/// NAME or NAME:WHAT
Option add_plug(Command& command, const std::string& name, std::optional<Plug>& plug,
                const std::string& help);

/// human, NAME or NAME:FILE
Option add_responder(Command& command, std::optional<ResponderChoice>& responder,
                     const std::string& help);
/// The same for several models.
Option add_responders(Command& command, std::vector<ResponderChoice>& responders,
                      const std::string& help);

/// One of an enumeration's names.
template <typename Enum>
Option add_choice(Command& command, const std::string& name, std::optional<Enum>& choice,
                  const std::string& help, const std::vector<std::string>& names) {
  // Other texts were refused before.
  return command
      .add_option(name, ReadsText{[&choice](const std::string& text) { from_text(text, choice); }},
                  help)
      .one_of(names);
}

/// Adds --camera-file, --board, --effector.
void add_apparatus_options(Command& command, SessionOptions& given);

/// Adds --set.
void add_settings(Command& command, std::vector<ProtocolSetting>& settings,
                  const std::string& help);

/// Adds --responder, --tracker, --view and the options of the apparatus.
/// @param stay missing options keep the session's values; otherwise --help shows defaults
void add_session_options(Command& command, SessionOptions& given, bool stay = false);

/// Prints which default calibration is used, on stderr.
void print_camera_file(const SessionOptions& given, const SessionConfig& config);

/// Prints a simulator's known defects, if any, on stderr.
void warn_of_simulator(const std::string& name);

/// The same for the simulator that a session starts with, and the protocol's cautions; for `auto`
/// also the chosen simulator and the reason.
void print_simulator(const ResolvedConfig& config);

/// Cautions about a valid protocol, one sentence each; usually none.
std::vector<std::string> cautions(const Protocol& protocol);

/// Adds --operator, --backup, --events.
void add_output_options(Command& command, SessionOptions& given,
                        std::optional<EventTarget>& events);

/// Adds --unverified.
void add_unverified(Command& command, bool& unverified);

/// Verifies logs, with a progress bar.
/// @throws Error (diverged) if one is not sound, unless `unverified`
LogIntegrity integrity_of(const std::vector<std::string>& databases,
                          const std::vector<std::int64_t>& session_ids, bool unverified);

/// Backs up the log and prints where, or a warning that there is no backup, which does not affect
/// the session.
/// @param folder empty: no backup is wanted
void back_up_and_report(const std::string& db, const std::string& folder, std::int64_t session_id);

/// Prints how a session ended, and the next step.
void say_finished(const SessionResult& result, const std::string& db);

struct CommandedSession {
  const ResolvedConfig& config;
  std::string db;
  bool unblind = false;
  bool ignore_failed_checks = false;
  std::optional<EventTarget> events = {};
  std::string place = {};  ///< in a study, "7 of 24"
};

/// Adds --ignore-failed-checks.
void add_ignore_failed_checks(Command& command, bool& ignore_failed_checks);

/// Runs `run` with Ctrl-C as a clean stop, and with a progress bar, or the experimenter's console
/// if the session runs in real time. A participant who declines ends it as well. Afterwards the log
/// is backed up to the configuration's folder.
/// @throws Error before the session if it could not be backed up; Error (interrupted) when stopped,
///   with how to continue; Error if the session is paused
SessionResult run_session(const CommandedSession& session,
                          const std::function<SessionResult(const RunnerOptions&)>& run);

}  // namespace heft::cli
