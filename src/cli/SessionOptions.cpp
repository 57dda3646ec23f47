#include "cli/SessionOptions.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <tuple>

#include "base/Error.h"
#include "base/Names.h"
#include "base/SimulationChoices.h"
#include "cli/console/Terminal.h"
#include "cli/console/TerminalConsole.h"
#include "physics/DecouplingSimulator.h"
#include "physics/auto/Choice.h"
#include "protocol/Protocol.h"
#include "record/writer/Backup.h"
#include "replay/Replay.h"
#include "session/Session.h"

namespace heft::cli {

namespace {
// A function that parses an option's text into `value`.
template <typename Value>
ReadsText reads(std::string option, Value& value, const char* expected) {
  return {[option = std::move(option), &value, expected](const std::string& text) {
    Value read{};
    if (!from_text(text, read))
      throw Error(fmt::format("{} {}: expected {}", option, text, expected), ExitCode::usage);
    value = std::move(read);
  }};
}

void refuse_unfinished(const std::string& option, const std::string& text) {
  if (text.ends_with(':'))
    throw Error(fmt::format("{0} {1}: nothing follows the colon, expected {2} or {1}FILE", option,
                            text, text.substr(0, text.size() - 1)),
                ExitCode::usage);
}

template <typename Value>
ReadsText reads_plug(const std::string& option, std::optional<Value>& plug) {
  return {[option, &plug](const std::string& text) {
    refuse_unfinished(option, text);
    from_text(text, plug.emplace());
  }};
}

std::string with_default(const char* help, const char* without_it, bool stay) {
  return stay ? help : fmt::format("{} (default: {})", help, without_it);
}
}  // namespace

Option add_plug(Command& command, const std::string& name, std::optional<Plug>& plug,
                const std::string& help) {
  return command.add_option(name, reads_plug(name, plug), help);
}

Option add_responder(Command& command, std::optional<ResponderChoice>& responder,
                     const std::string& help) {
  return command.add_option("--responder", reads_plug("--responder", responder), help);
}

Option add_responders(Command& command, std::vector<ResponderChoice>& responders,
                      const std::string& help) {
  const auto read = [&responders](const std::string& text) {
    refuse_unfinished("--responder", text);
    from_text(text, responders.emplace_back());
  };
  return command.add_option("--responder", ReadsText{read, true}, help);
}

namespace {
void add_files_of_apparatus(Command& command, SessionOptions& given, bool stay) {
  command.add_option(
      "--camera-file", &given.camera_file,
      with_default("the camera's calibration, from heft calibrate camera",
                   "camera.yaml in this folder; a synthetic one for synthetic and mouse", stay));
  command.add_option("--board", &given.board_file,
                     with_default("the printed board", "protocols/apparatus/board.toml", stay));
  command.add_option(
      "--effector", &given.effector_file,
      with_default("the effector's tags", "protocols/apparatus/effector.toml", stay));
}
}  // namespace

void add_apparatus_options(Command& command, SessionOptions& given) {
  command.group("Apparatus");
  add_files_of_apparatus(command, given, false);
}

void add_session_options(Command& command, SessionOptions& given, bool stay) {
  command.group(stay ? "Changes from here on (the rest is kept)" : "Responder, tracker and view");
  add_responder(
      command, given.responder,
      with_default("human, or a model: NAME or NAME:FILE (heft doctor --list)", "human", stay));
  add_plug(
      command, "--tracker", given.tracker,
      with_default(
          "source of effector poses: camera:N, video:FILE, frames:FOLDER, synthetic (a "
          "rendered camera films a model's hand; synthetic:FILE.toml sets its imperfections), hand "
          "(that hand's true pose), "
          "mouse (the participant drags the effector in the window with the mouse or a finger and "
          "turns it "
          "with the wheel: for trying and teaching without printed tags)",
          "camera:0 for a person, hand for a model", stay));
  add_plug(command, "--view", given.view,
           with_default("display of the session: window, headless, video:FILE",
                        "window for a person, headless for a model", stay));
  if (!stay) command.group("Apparatus");
  add_files_of_apparatus(command, given, stay);
  command.add_option(
      "--display",
      reads("--display", given.display, "the number of a display, from 0 (heft doctor --list)"),
      with_default("the number of the display that the window is on (heft doctor "
                   "lists them)",
                   "0", stay));
  command.add_option("--display-file", &given.display_file,
                     with_default("the measured display, from heft calibrate display",
                                  "display.toml in this folder, if it exists", stay));
  command.add_flag("--windowed", given.windowed,
                   "the window does not fill the display; F11 toggles that");
}

void add_settings(Command& command, std::vector<ProtocolSetting>& settings,
                  const std::string& help) {
  const auto read = [&settings](const std::string& text) {
    ProtocolSetting setting;
    if (!from_text(text, setting) || text.find('\n') != std::string::npos)
      throw Error(fmt::format("--set {}: expected KEY=VALUE, such as "
                              "coupling.stiffness_n_per_m=100 or block.sorting.trials=4",
                              text),
                  ExitCode::usage);
    settings.push_back(std::move(setting));
  };
  command.add_option("--set", ReadsText{read, true}, help);
}

void add_ignore_failed_checks(Command& command, bool& ignore_failed_checks) {
  command.add_flag("--ignore-failed-checks", ignore_failed_checks,
                   "continue after a FAILED check of the apparatus where there is no terminal "
                   "to ask; it is logged");
}

void add_output_options(Command& command, SessionOptions& given,
                        std::optional<EventTarget>& events) {
  command.group("Backups and other recorders");
  command.add_option("--operator", &given.run_by,
                     "who runs the session, for the log (default: the study plan's; for a resumed "
                     "session, the one it had)");
  command.add_option(
      "--backup", &given.backup,
      "a folder, preferably on another disk: after the session a copy of the log is saved and "
      "verified there (default: the study plan's; for a resumed session, the one it had)");
  const auto read = [&events](const std::string& text) { events = parse_event_target(text); };
  command.add_option("--events", ReadsText{read},
                     "udp:HOST:PORT, fifo:PATH or serial:DEVICE: one line of JSON for each event, "
                     "with its t_s and UTC; the session never waits for it");
}

void print_camera_file(const SessionOptions& given, const SessionConfig& config) {
  const auto usual = std::filesystem::absolute(default_camera_file).lexically_normal();
  if (!given.camera_file && config.camera.path == usual)
    say("camera calibration: {}\n", default_camera_file);
}

void warn_of_simulator(const std::string& name) {
  const SimulatorEntry& entry = simulator_named(name);
  if (!entry.warning.empty()) say("heft: {} {}\n", entry.name, entry.warning);
}

void print_simulator(const ResolvedConfig& config) {
  const SimulatorChoice& simulator = config->protocol->simulator;
  if (const std::string& why = config->config.simulator_reason; !why.empty())
    say("heft: {}\n", heft::described({simulator.name, simulator.rate_hz, why}));
  warn_of_simulator(simulator.name);
  for (const std::string& caution : cautions(*config->protocol)) say("heft: {}\n", caution);
}

void add_unverified(Command& command, bool& unverified) {
  command.add_flag("--unverified", unverified,
                   "do not check first whether the log was changed; all figures are marked");
}

namespace {
// A session that is in two logs would count twice.
void refuse_copies(const std::vector<std::string>& databases) {
  using Key = std::tuple<std::string, std::string, std::uint64_t, std::string>;
  std::map<Key, std::pair<std::string, std::int64_t>> found;
  for (const std::string& database : databases) {
    const auto sessions = LogReader(database).sessions();
    if (sessions.empty()) throw Error(fmt::format("{} holds no session yet", database));
    for (const auto& [id, header, state] : sessions) {
      if (state == SessionState::withdrawn) continue;
      const auto [at, is_new] = found.try_emplace(
          {header.participant, header.started_utc, header.seed, header.protocol_sha256}, database,
          id);
      const auto& [other, other_id] = at->second;
      if (is_new || other == database) continue;
      if (std::filesystem::equivalent(other, database))
        throw Error(fmt::format("{} is given twice", database), ExitCode::usage);
      throw Error(
          fmt::format("session {} of {} and session {} of {} are the same (participant "
                      "{}, started {}): one log has copies of the other's sessions. Give "
                      "each session once",
                      other_id, other, id, database, header.participant, header.started_utc),
          ExitCode::usage);
    }
  }
}
}  // namespace

LogIntegrity integrity_of(const std::vector<std::string>& databases,
                          const std::vector<std::int64_t>& session_ids, bool unverified) {
  refuse_copies(databases);
  if (unverified) return {false, "NOT VERIFIED"};
  ProgressBar bar("verifying");
  std::vector<std::string> heads;
  for (const std::string& database : databases) {
    const std::string head =
        require_verified(database, session_ids, [&](double done) { bar.update(done, database); });
    heads.push_back(head.empty() ? "none" : short_head(head));
  }
  return {true, fmt::format("verified, head {}", fmt::join(heads, ", "))};
}

void back_up_and_report(const std::string& db, const std::string& folder, std::int64_t session_id) {
  if (folder.empty()) return;
  try {
    say("verified backup: {}\n", back_up(db, folder, session_id));
  } catch (const std::exception& error) {
    ring();
    say("heft: WARNING: there is NO BACKUP of session {}: {}. The session itself is saved in {}; "
        "copy it and the files beside it to a safe place: cp {}* FOLDER\n",
        session_id, error.what(), db, shell_quoted(db));
  }
}

namespace {
// Reports a bad backup folder before the session.
void check_backup(const std::string& folder) try {
  if (folder.empty()) return;
  require_backup_folder(folder);
  say("a copy of the log will be saved in {}\n", folder);
} catch (const Error& error) {
  throw Error(
      fmt::format("{}. The session has not begun. Correct that folder, or give another with "
                  "--backup FOLDER",
                  error.what()));
}

void report_dropped(const EventOutlet& events, const std::string& where) {
  if (events.n_dropped() == 0) return;
  say("heft: WARNING: {} of {} events could not be sent to {}, because they were not read in time. "
      "All of them are in the log\n",
      events.n_dropped(), events.n_dropped() + events.n_sent(), where);
}

void say_head(const SessionResult& result, const std::string& db) {
  if (result.head.empty())
    return say("{} is locked by another program; the next session seals this one\n", db);
  say("head of the log: {0}; note it in the lab book\n"
      "check the log with it: heft replay --db {1} --witness {0}\n",
      short_head(result.head), shell_quoted(db));
}

// Declining is everyone's right, and no error.
void say_declined(const SessionResult& result, const std::string& db) {
  say("the participant declined: session {} has ended as aborted, before its first "
      "trial; this is saved in {}\n",
      result.session_id, db);
}

[[noreturn]] void report_unfinished(const SessionResult& result, const std::string& db) {
  say_head(result, db);
  const std::string resume =
      fmt::format("heft resume --db {} --session {}", shell_quoted(db), result.session_id);
  if (result.end == RunEnd::stopped)
    throw Error("stopped; everything up to the last answer is saved. Continue with: " + resume,
                ExitCode::interrupted);
  ring();
  throw Error(
      fmt::format("the session is paused: one trial was void {} times. Check the "
                  "camera and the board, then continue with: {}",
                  max_voids, resume));
}
}  // namespace

void say_finished(const SessionResult& result, const std::string& db) {
  say_head(result, db);
  if (result.end == RunEnd::declined) return say_declined(result, db);
  say("session {} is finished: {}, {:.0f} min of session time, all saved in {}\n"
      "results: heft analyse --db {}\n"
      "check the log: heft replay --db {} --session {}\n",
      result.session_id, counted(result.n_completed, "trial"), result.duration_s / 60, db,
      shell_quoted(db), shell_quoted(db), result.session_id);
}

SessionResult run_session(const CommandedSession& session,
                          const std::function<SessionResult(const RunnerOptions&)>& run) {
  std::optional<EventOutlet> events;
  if (session.events) events.emplace(*session.events);
  check_backup(session.config->config.backup);
  const StopOnSignal stop_on_signal;
  std::optional<SuspendOnSignal> suspend_on_signal;
  ProgressBar bar("session");
  std::optional<TerminalConsole> console;
  const double expected = total_of(expected_trials(*session.config->protocol));
  RunnerOptions options;
  options.stop = &stop_on_signal.requested();
  options.ignore_failed_checks = session.ignore_failed_checks;
  options.events = events ? &*events : nullptr;
  options.print = [](const std::string& text) { say("heft: {}\n", text); };
  if (session.config->on_wall_clock) {
    options.suspend = &suspend_on_signal.emplace().requested();
    options.stop_process = SuspendOnSignal::stop_now;
    options.console = &console.emplace(expected, session.unblind, session.place);
  } else  // blind: no mass, level, condition or correctness
    options.progress = [&](const Engine& engine) {
      bar.update(expected > 0 ? engine.n_completed() / expected : 0,  // a demonstration alone: 0
                 fmt::format("{} trials, {:.0f} min", of_about(engine.n_completed(), expected),
                             engine.last_s() / 60));
    };
  std::int64_t begun = 0;
  options.begun = &begun;
  SessionResult result;
  try {
    result = run(options);
  } catch (...) {  // the error is reported below the backup, where it remains visible
    console.reset();
    if (begun > 0) back_up_and_report(session.db, session.config->config.backup, begun);
    throw;
  }
  console.reset();
  if (events) report_dropped(*events, session.events->text);
  back_up_and_report(session.db, session.config->config.backup, result.session_id);
  if (result.end == RunEnd::stopped || result.end == RunEnd::paused)
    report_unfinished(result, session.db);
  return result;
}

}  // namespace heft::cli
