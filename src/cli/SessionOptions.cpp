#include "cli/SessionOptions.h"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <span>
#include <vector>

#include "apparatus/EventOutlet.h"
#include "base/DefaultTechniques.h"
#include "base/Error.h"
#include "base/PlugTable.h"
#include "cli/Installation.h"
#include "cli/Terminal.h"
#include "cli/TerminalConsole.h"
#include "physics/DecouplingSimulator.h"
#include "physics/Oracles.h"
#include "physics/auto/Choice.h"
#include "protocol/ExpectedLength.h"
#include "record/Backup.h"
#include "session/Session.h"

namespace heft::cli {

namespace {
struct SessionOption {
  const char* name;
  std::optional<std::string> GivenOptions::*given;
  const char *help, *without_it;
};

constexpr std::array who_and_what{
    SessionOption{"--responder", &GivenOptions::responder,
                  "human, or a model: NAME or NAME:FILE (heft doctor lists them)", "human"},
    SessionOption{
        "--tracker", &GivenOptions::tracker,
        "where effector poses come from: camera:N, video:FILE, frames:FOLDER, synthetic (a "
        "rendered camera films a model's hand; synthetic:FILE.toml says what it gets wrong, "
        "as protocols/apparatus/synthetic_camera.toml explains), hand (that hand as it is), mouse "
        "(you drag the effector in the window with the mouse or a finger and turn it with the "
        "wheel: to try and to teach without a print)",
        "camera:0 for a person, hand for a model"},
    SessionOption{"--view", &GivenOptions::view,
                  "what shows the session: window, headless, video:FILE",
                  "window for a person, headless for a model"}};

constexpr std::array display_options{
    SessionOption{"--display", &GivenOptions::display,
                  "the number of the display that the window is on (heft doctor lists them)", "0"},
    SessionOption{"--display-file", &GivenOptions::display_file,
                  "the measured display, from heft calibrate display",
                  "display.toml in this folder, if there is one"}};

constexpr std::array apparatus_options{
    SessionOption{"--camera-file", &GivenOptions::camera_file,
                  "the camera's calibration, from heft calibrate camera",
                  "camera.yaml in this folder, for synthetic and mouse a made-up one"},
    SessionOption{"--board", &GivenOptions::board_file, "the printed board",
                  "protocols/apparatus/board.toml"},
    SessionOption{"--effector", &GivenOptions::effector_file, "the effector's tags",
                  "protocols/apparatus/effector.toml"}};

void add_options(Command& command, GivenOptions& given, std::span<const SessionOption> options,
                 bool stay) {
  for (const SessionOption& option : options)
    command.add_option(
        option.name, &(given.*option.given),
        stay ? option.help : fmt::format("{} (default: {})", option.help, option.without_it));
}
}  // namespace

void add_apparatus_options(Command& command, GivenOptions& given) {
  command.group("Apparatus");
  add_options(command, given, apparatus_options, false);
}

void add_session_options(Command& command, GivenOptions& given, bool stay) {
  command.group(stay ? "What is another from here on (the rest stays as it was)"
                     : "Who answers, what films, what shows");
  add_options(command, given, who_and_what, stay);
  if (!stay) command.group("Apparatus");
  add_options(command, given, apparatus_options, stay);
  add_options(command, given, display_options, stay);
  command.add_flag("--windowed", given.windowed,
                   "the window does not fill the display; F11 changes that, too");
}

void add_settings(Command& command, std::vector<std::string>& settings) {
  command.add_option("--set", &settings,
                     "change a key of the protocol, such as coupling.stiffness_n_per_m=100; kept "
                     "with the session");
}

void add_go_on(Command& command, bool& go_on) {
  command.add_flag("--go-on", go_on,
                   "go on although the check of the apparatus FAILED, where there is no terminal "
                   "to ask at; it is logged");
}

void add_elsewhere_options(Command& command, Elsewhere& elsewhere) {
  command.group("Backups and other recorders");
  command.add_option(
      "--backup", &elsewhere.backup,
      "a folder, best on another disk: after the session a copy of the log is put "
      "there and checked (default: the study plan's; of a session that goes on, the one it had)");
  command.add_option("--events", &elsewhere.events,
                     "udp:HOST:PORT, fifo:PATH or serial:DEVICE: a line of JSON for each event, "
                     "once it is in the log, with its t_s and UTC; the session never waits for it");
}

namespace {
// What was given, or the file that comes with the program; looked for only where it is needed.
std::string or_shipped(const std::optional<std::string>& given, const char* shipped) {
  return given ? *given : installed_file(shipped);
}
}  // namespace

SessionConfig with_defaults(const GivenOptions& given) {
  SessionConfig options;
  options.responder = given.responder.value_or("human");
  const bool person = has_person(options);
  options.tracker = given.tracker.value_or(person ? "camera:0" : "hand");
  options.view = given.view.value_or(person ? "window" : "headless");
  options.simulator = given.simulator.value_or("");
  options.display = given.display.value_or("");
  options.display_file = given.display_file.value_or("");
  if (given.windowed) options.window = "window";
  options.settings = fmt::format("{}", fmt::join(given.settings, "\n"));
  const std::string tracker = split_name(options.tracker).name;
  const bool synthetic = tracker == "synthetic" || tracker == "mouse";
  options.camera_file =
      synthetic ? or_shipped(given.camera_file, "protocols/apparatus/synthetic_camera.yaml")
                : given.camera_file.value_or("");
  options.board_file = or_shipped(given.board_file, "protocols/apparatus/board.toml");
  options.effector_file = or_shipped(given.effector_file, "protocols/apparatus/effector.toml");
  return options;
}

void complete_and_tell(SessionConfig& options) {
  const bool named = !options.camera_file.empty();
  complete(options);
  if (!named && !options.camera_file.empty()) say("camera calibration: {}\n", default_camera_file);
}

void warn_of_simulator(const std::string& name) {
  const SimulatorEntry& entry = simulator_named(name);
  if (!entry.warning.empty()) say("heft: {} {}\n", entry.name, entry.warning);
}

void tell_simulator(const Protocol& protocol, const SessionConfig& options) {
  const SimulatorChoice simulator = protocol_for(protocol, options)->simulator;
  if (!options.simulator_why.empty())
    say("heft: {}\n", heft::described({simulator.name, simulator.rate_hz, options.simulator_why}));
  warn_of_simulator(simulator.name);
  for (const std::string& caution : cautions(protocol)) say("heft: {}\n", caution);
}

// Simulators for one stroke alone; and over video people see how far the clone is from the
// effector, and take it for mass.
std::vector<std::string> cautions(const Protocol& protocol) {
  constexpr double stroke_m_s = 0.3;
  const auto& [mode, predict_s] = protocol.simulator.input;
  std::vector<std::string> found;
  const std::string& simulator = protocol.simulator.name;
  if (!entry_named("simulator", simulator, simulators()).for_sessions)
    found.push_back(fmt::format(
        "[physics] simulator = \"{}\" models one straight push: sessions refuse it where a hand "
        "does more: use \"boxes\" or \"auto\"",
        simulator));
  if (mode == InputMode::hold || mode == InputMode::extrapolate)
    found.push_back(
        fmt::format("[physics] input = \"{}\" is for see-through displays; over video, where the "
                    "clone is seen beside the filmed effector, it adds false mass: use \"path\"",
                    name_of(mode)));
  if (protocol.layout.out_of_area == OutOfArea::give_back)
    found.push_back(
        "[layout] out_of_area = \"return\", also where nothing is said, tells the mass: light "
        "cubes "
        "jump home in most trials, heavy ones hardly ever: use \"together\"");
  if (predict_s > 0) {
    const Scene scene = scene_of(protocol, coupled_technique, {});
    const double ahead_m = stroke_m_s * predict_s;
    const double slide_n_per_kg = sliding_force_n(scene.friction, 1, scene.gravity_m_s2);
    const std::string false_mass =
        slide_n_per_kg > 0
            ? fmt::format(", about {:.0f} g of false mass",
                          1e3 * scene.coupling.stiffness_n_per_m * ahead_m / slide_n_per_kg)
            : "";
    found.push_back(fmt::format(
        "[physics] predict_s = {} is for see-through displays; over video the clone runs {:.0f} mm "
        "ahead of an effector filmed at {} m/s{}: use 0",
        predict_s, 1e3 * ahead_m, stroke_m_s, false_mass));
  }
  return found;
}

std::string texts_file(const std::string& language) {
  if (language.ends_with(".toml")) return language;
  const std::filesystem::path folder =
      std::filesystem::path(installed_file("protocols/texts/en.toml")).parent_path();
  std::vector<std::string> shipped;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".toml") shipped.push_back(entry.path().stem().string());
  std::ranges::sort(shipped);
  if (std::ranges::find(shipped, language) == shipped.end())
    throw unknown_name("language", language,
                       std::vector<std::string_view>(shipped.begin(), shipped.end()));
  return (folder / (language + ".toml")).string();
}

void back_up_and_tell(const std::string& db, const std::string& folder, std::int64_t session_id) {
  if (folder.empty()) return;
  try {
    say("backup, checked: {}\n", back_up(db, folder, session_id));
  } catch (const std::exception& error) {
    ring();
    say("heft: WARNING: there is NO BACKUP of session {}: {}. The session itself is saved in {}; "
        "copy that file to a safe place: cp {} FOLDER\n",
        session_id, error.what(), db, shell_quoted(db));
  }
}

std::string backup_folder(const Elsewhere& elsewhere) {
  if (elsewhere.backup.empty()) return "";
  return std::filesystem::absolute(elsewhere.backup).lexically_normal().string();
}

namespace {
// Known before the session, not after it.
void check_backup(const std::string& folder) try {
  if (folder.empty()) return;
  require_backup_folder(folder);
  say("a copy of the log will be put into {}\n", folder);
} catch (const Error& error) {
  throw Error(
      fmt::format("{}. The session has not begun. See to that folder, or give another with "
                  "--backup FOLDER",
                  error.what()));
}

void tell_dropped(const EventOutlet& events, const std::string& where) {
  if (events.n_dropped() == 0) return;
  say("heft: WARNING: {} of {} events could not be handed on to {}: nobody took them in time. All "
      "of them are in the log\n",
      events.n_dropped(), events.n_dropped() + events.n_sent(), where);
}

// Not to take part is everybody's right, and no error.
void say_declined(const SessionResult& result, const std::string& db) {
  say("the participant declined to take part: session {} is ended as aborted, before its first "
      "trial; that is saved in {}\n",
      result.session_id, db);
}
}  // namespace

void say_finished(const SessionResult& result, const std::string& db) {
  if (result.end == RunEnd::declined) return say_declined(result, db);
  say("session {} is finished: {} trials, {:.0f} minutes of session time, all saved in {}\n"
      "what was found: heft analyse --db {}\n"
      "check the log: heft replay --db {} --session {}\n",
      result.session_id, result.n_completed, result.duration_s / 60, db, shell_quoted(db),
      shell_quoted(db), result.session_id);
}

SessionResult run_session(const CommandedSession& session,
                          const std::function<SessionResult(const RunnerOptions&)>& run) {
  std::optional<EventOutlet> events;
  if (!session.events.empty()) events.emplace(session.events);
  check_backup(session.setup.backup);
  const StopOnSignal stop_on_signal;
  ProgressBar bar("session");
  std::optional<TerminalConsole> console;
  const double expected = expected_length(session.protocol).trials;
  RunnerOptions options;
  options.stop = &stop_on_signal.requested();
  options.go_on_unchecked = session.go_on_unchecked;
  options.events = events ? &*events : nullptr;
  options.tell = [](const std::string& text) { say("heft: {}\n", text); };
  if (runs_on_wall_clock(session.setup))
    options.console = &console.emplace(expected, session.unblind, session.place);
  else  // nothing that would unblind whoever watches: no mass, level, condition or correctness
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
  } catch (...) {  // what went wrong is told below the backup, where it stays in sight
    console.reset();
    if (begun > 0) back_up_and_tell(session.db, session.setup.backup, begun);
    throw;
  }
  console.reset();
  if (events) tell_dropped(*events, session.events);
  back_up_and_tell(session.db, session.setup.backup, result.session_id);
  const std::string resume =
      fmt::format("heft resume --db {} --session {}", shell_quoted(session.db), result.session_id);
  if (result.end == RunEnd::stopped)
    throw Error("stopped; everything up to the last answer is saved. Go on with: " + resume,
                ExitCode::interrupted);
  if (result.end == RunEnd::paused) {
    ring();
    throw Error(
        fmt::format("the session paused itself: one trial was void {} times. Look at the "
                    "camera and the board, then go on with: {}",
                    max_voids, resume));
  }
  return result;
}

}  // namespace heft::cli
