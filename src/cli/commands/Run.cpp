// heft run: runs one participant's session.
#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <iostream>
#include <memory>

#include "apparatus/StudyPlaces.h"
#include "apparatus/sources/PictureSource.h"
#include "base/Error.h"
#include "base/files/TextFile.h"
#include "cli/Commands.h"
#include "cli/SessionOptions.h"
#include "cli/console/Terminal.h"
#include "experiment/Participant.h"
#include "protocol/readers/Files.h"
#include "session/Session.h"

namespace heft::cli {

namespace {
struct RunOptions {
  std::string protocol, plan;
  std::optional<EventTarget> events;
  std::optional<std::string> participant, db;
  std::optional<std::uint64_t> seed;
  SessionOptions given;
  std::optional<Purpose> purpose;
  std::optional<double> text_size;
  std::map<std::string, std::string> participant_info;  // assigned by the plan
  bool unblind = false, again = false, keys = false, ignore_failed_checks = false;
  bool changed_protocol = false;
  bool are_two = false;  // a participant with a similar id, confirmed to be another person
};

void check_participant(const std::string& id) {
  if (const auto wrong = wrong_with_id(id))
    throw Error(fmt::format("--participant: the id {}", *wrong), ExitCode::usage);
}

bool is_persons(const RunOptions& options) {
  return std::holds_alternative<Person>(options.given.responder.value_or(Person{}));
}

// A session played with the mouse counts as data only if requested.
Purpose purpose_of(const RunOptions& options) {
  const auto& tracker = options.given.tracker;
  const bool is_dragged = tracker && tracker_named(tracker->name).is_dragged;
  return options.purpose.value_or(is_dragged ? Purpose::test : Purpose::main);
}

SessionOptions session_options(const RunOptions& options) {
  SessionOptions given = options.given;
  // Logged as a change of the protocol's key.
  if (options.text_size)
    given.settings.push_back({"screens.text_size", fmt::format("{}", *options.text_size)});
  if (!given.hand) given.hand = Side::right;
  if (is_persons(options))
    given.keys =
        options.keys || purpose_of(options) == Purpose::test ? TakesKeys::yes : TakesKeys::no;
  given.protocol_file = options.protocol;
  return given;
}

SessionRequest request_of(const RunOptions& options) {
  const SessionOptions given = session_options(options);
  SessionRequest request{resolve(given, load_protocol(options.protocol, given.settings),
                                 options.seed ? *options.seed : fresh_seed()),
                         options.participant.value(), options.db.value(), purpose_of(options)};
  request.participant_info = options.participant_info;
  request.again = options.again;
  print_camera_file(given, request.config->config);
  return request;
}

// Sessions of an existing log; none if the file is missing.
std::vector<SessionRow> sessions_in(const std::string& db) {
  refuse_special_file(db);
  std::error_code unknown;
  if (!std::filesystem::exists(db, unknown)) return {};
  return LogReader(db).sessions();
}

// The plan's values for options that are not given.
void fill_from(const StudyPlan& plan, RunOptions& options) {
  const auto fill = [](std::optional<std::string>& given,
                       const std::optional<std::string>& planned) {
    if (!given) given = planned;
  };
  fill(options.db, plan.db);
  if (!options.given.display && plan.display) options.given.display = NamedDisplay{*plan.display};
  fill(options.given.display_file, plan.display_file);
  if (options.given.backup.empty()) options.given.backup = plan.backup.value_or("");
  if (options.given.run_by.empty()) options.given.run_by = plan.run_by;
}

void give_place(const StudyPlan& plan, const PlannedParticipant& planned, RunOptions& options) {
  const StudyGroup& group = plan.groups[static_cast<std::size_t>(planned.place.group)];
  options.participant = planned.id;
  options.protocol = group.protocol;
  if (!options.given.language) options.given.language = group.language;
  const auto& order = plan.orders[static_cast<std::size_t>(planned.place.order)];
  if (!order.empty()) {
    for (const ProtocolSetting& setting : options.given.settings)
      if (setting.key == order_key)
        throw Error(fmt::format("the plan {} sets the order of blocks, expected no --set {}",
                                options.plan, to_text(setting)),
                    ExitCode::usage);
    options.given.settings.push_back(order_setting(order));
  }
  options.participant_info = info_of(plan, planned.place);
}

// Asks until the answer is y or n; the end of input means no.
bool answers_yes(const std::string& question) {
  for (std::string answer; say("{} y/n: ", question), std::getline(std::cin, answer);) {
    if (answer == "y" || answer == "yes") return true;
    if (answer == "n" || answer == "no") return false;
  }
  return false;
}

// Without a terminal the answer is no.
bool confirmed(const std::string& question) {
  const bool has_terminal = isatty(STDIN_FILENO) == 1 && isatty(STDERR_FILENO) == 1;
  return has_terminal && answers_yes(question);
}

// Asks about a similar id at a terminal; elsewhere only --again continues.
void refuse_unless_two_people(const std::string& found, RunOptions& options) {
  if (confirmed(found + ". Are these two people?")) {
    options.are_two = true;
    return;
  }
  throw Error(fmt::format("{}: give that id if it is the same person; if it is another, add "
                          "--again",
                          found),
              ExitCode::usage);
}

// A wrong id would take the next participant's place.
void refuse_unless_new(const StudyPlan& plan, const RunOptions& options) {
  const std::string found =
      fmt::format("the plan {} has no participant \"{}\"", options.plan, *options.participant);
  if (confirmed(found + ". Give this person the next free place?")) return;
  throw Error(
      fmt::format("{}, but {} to {}: correct the id, or add --again to give this person the next "
                  "free place",
                  found, planned_id(plan, 1), planned_id(plan, plan.participants)),
      ExitCode::usage);
}

// P2 instead of P02 would take another participant's place.
void refuse_id_near_to_planned(const StudyPlan& plan, const std::vector<SessionRow>& sessions,
                               RunOptions& options) {
  if (!options.participant || options.again) return;
  for (const SessionRow& session : sessions)
    if (session.header.participant == *options.participant) return;
  if (const auto near = near_planned_id(*options.participant, plan))
    refuse_unless_two_people(
        fmt::format("the plan {} has no participant \"{}\", but there is \"{}\"", options.plan,
                    *options.participant, *near),
        options);
  else if (!is_planned_id(*options.participant, plan))
    refuse_unless_new(plan, options);
}

// A group's participants must have the same protocol.
void refuse_changed_protocol(const StudyPlan& plan, const std::vector<SessionRow>& sessions,
                             Purpose purpose, const StudyGroup& group, const RunOptions& options) {
  const auto [participants, since_the_last] = had_another_protocol(
      plan, sessions, purpose, group.name, load_protocol(group.protocol).sha256);
  if (participants.empty()) return;
  const std::string found =
      fmt::format("{} is not what participant{} {} {}had", group.protocol,
                  participants.size() == 1 ? "" : "s", fmt::join(participants, ", "),
                  group.name.empty() ? "" : fmt::format("of the group \"{}\" ", group.name));
  if (!since_the_last || options.changed_protocol) return say("heft: WARNING: {}\n", found);
  if (confirmed(found + ": it was changed since then. Continue with the changed one?")) return;
  throw Error(
      fmt::format("{}: it was changed since then. Undo the change, give the changed study another "
                  "name, or add --changed-protocol to continue with the changed one; the log "
                  "records each participant's version",
                  found),
      ExitCode::usage);
}

void take_from_plan(RunOptions& options) {
  if (!options.protocol.empty())
    throw Error(fmt::format("the plan {} selects the protocol, expected no other one ({})",
                            options.plan, options.protocol),
                ExitCode::usage);
  const StudyPlan plan = load_study(options.plan);
  fill_from(plan, options);
  if (!options.db) options.db = usual_log;
  const Purpose purpose = is_persons(options) ? purpose_of(options) : Purpose::simulated;
  const std::vector<SessionRow> sessions = sessions_in(*options.db);
  const PlannedParticipant planned =
      planned_participant(plan, sessions, purpose, options.participant);
  refuse_id_near_to_planned(plan, sessions, options);
  refuse_changed_protocol(plan, sessions, purpose,
                          plan.groups[static_cast<std::size_t>(planned.place.group)], options);
  give_place(plan, planned, options);
  for (const SessionRow& session : sessions)
    if (is_unfinished(session.state) && place_of(session.header.participant_info))
      say("session {} of participant {} is unfinished: heft resume --db {} --session {}\n",
          session.session_id, session.header.participant, shell_quoted(*options.db),
          session.session_id);
  const std::string rehearsal =
      purpose == Purpose::main
          ? ""
          : fmt::format("; purpose {}, which takes no place or id", name_of(purpose));
  say("participant {} of the study {}: {} of {}{}\n", planned.id, plan.name, planned.place.number,
      plan.participants, rehearsal);
}

// Typing 1 instead of 01 would separate one person's sessions.
void refuse_near_id(RunOptions& options) {
  if (options.again || options.are_two) return;
  if (const auto near = near_id(*options.participant, sessions_in(*options.db)))
    refuse_unless_two_people(fmt::format("participant \"{}\" is new in {}, but there is \"{}\"",
                                         *options.participant, *options.db, *near),
                             options);
}

// A plan is easily given as a protocol, and the reverse; other mistakes in a file are reported by
// its reader.
void refuse_other_kind(const std::string& path, FileKind expected) {
  std::optional<FileKind> kind;
  try {
    kind = recognized_kind(read_text_file(path), path);
  } catch (const Error&) {
  }
  const std::string file = shell_quoted(path);
  if (kind == FileKind::study && expected == FileKind::protocol)
    throw Error(fmt::format("{} is a study plan: heft run --plan {}", path, file), ExitCode::usage);
  if (kind == FileKind::protocol && expected == FileKind::study)
    throw Error(
        fmt::format("{} is a protocol, not a study plan: heft run {} --participant ID", path, file),
        ExitCode::usage);
}

[[noreturn]] void refuse_missing(const char* option) {
  throw Error(
      fmt::format("{} is required, or --plan STUDY.toml, which provides it; see heft run --help",
                  option),
      ExitCode::usage);
}

void complete(RunOptions& options) {
  if (options.participant) check_participant(*options.participant);
  if (!options.plan.empty()) {
    refuse_other_kind(options.plan, FileKind::study);
    take_from_plan(options);
  } else if (!options.protocol.empty()) {
    refuse_other_kind(options.protocol, FileKind::protocol);
  }
  if (options.protocol.empty()) refuse_missing("PROTOCOL");
  if (!options.participant) refuse_missing("--participant");
  check_participant(*options.participant);
  if (!options.db) options.db = usual_log;
}

void run(RunOptions options) {
  complete(options);
  const SessionRequest request = request_of(options);
  refuse_near_id(options);
  say("participant {}, protocol {}, responder {}, seed {}\n", request.participant,
      request.config->protocol->name, to_text(request.config->config.responder),
      request.config->seed);
  print_simulator(request.config);
  if (request.config->tracker->is_dragged)
    say("heft: drag the effector in the window (tracker mouse) with mouse or finger; the wheel or "
        "a second finger turns it. For trying and teaching only; the log and every report say "
        "so\n");
  const auto start = [&](const RunnerOptions& runner) { return start_session(request, runner); };
  say_finished(
      run_session({request.config, request.db, options.unblind, options.ignore_failed_checks,
                   options.events, place_words(options.participant_info)},
                  start),
      request.db);
}

}  // namespace

void add_run(Command& app) {
  const auto options = std::make_shared<RunOptions>();
  Command command = app.add_command(
      "run", "run one participant's session of a protocol",
      {"heft run protocols/paper.toml --participant 07 --camera-file camera.yaml --db lab.db",
       "heft run protocols/quick.toml --participant me --tracker mouse",
       "heft run protocols/quick.toml --participant 07 --tracker synthetic",
       "heft run protocols/quick.toml --participant 07 --responder simulated --tracker synthetic "
       "--record-camera pictures",
       "heft run protocols/quick.toml --participant 07 --responder simulated",
       "heft run protocols/paper.toml --participant 07 --responder simulated --seed 42 --db lab.db",
       "heft run protocols/jnd.toml --participant 07 --responder scripted:recorded/07 --db "
       "lab.db",
       "heft run --plan study/STUDY.toml",
       "heft run protocols/paper.toml --participant 07 --backup /media/stick --events "
       "udp:127.0.0.1:5005"});
  command.add_option("PROTOCOL", &options->protocol, "a protocol file (not with --plan)");
  command.add_option("--plan", &options->plan,
                     "a study plan instead: runs its next participant's session");
  command.add_option("--participant", &options->participant,
                     "the participant's id (default with --plan: the next)");
  command.add_option("--db", &options->db, "the log; sessions are added (default: heft.db)");
  command.add_seed(options->seed);
  add_session_options(command, options->given);
  add_output_options(command, options->given, options->events);
  command.group("The protocol and the log");
  command.add_option("--simulator", &options->given.simulator, "instead of the protocol's");
  add_settings(command, options->given.settings,
               "change a key of the protocol, such as coupling.stiffness_n_per_m=100; kept with "
               "the session");
  command.add_option("--language", &options->given.language,
                     "of the participant's screens: en, fr, or a text FILE.toml (default: the "
                     "protocol's)");
  command.add_flag("--keys", options->keys,
                   "let the participant's window take keys as answers (default: only with "
                   "--purpose test); otherwise keys there do nothing");
  add_choice(command, "--hand", options->given.hand,
             "that holds the effector, for the demonstration (default: right)", {"left", "right"});
  add_choice(command, "--controls", options->given.controls,
             "the side of the buttons on the screen, for the tapping hand; the cubes "
             "keep their places (default: right)",
             {"left", "right"});
  command
      .add_option("--text-size", &options->text_size,
                  fmt::format("size of the participant's texts, {} to {} times the usual, as "
                              "--set screens.text_size=... (default: the protocol's)",
                              least_text_size, most_text_size))
      .between(least_text_size, most_text_size);
  add_choice(command, "--purpose", options->purpose,
             "of a person's session; analyse separates them (default: main, but test with "
             "--tracker mouse)",
             {"main", "pilot", "test"});
  command.add_option("--record-camera", &options->given.record_camera,
                     "store the camera's pictures in this folder, with their times in times.csv "
                     "(default: not stored). For a synthetic camera truth.csv has the true "
                     "poses: frame (from 0), t_s, and x_m...camera_qz as in heft track");
  command.add_flag("--unblind", options->unblind,
                   "show the experimenter masses and conditions; it is logged");
  add_ignore_failed_checks(command, options->ignore_failed_checks);
  command.add_flag("--changed-protocol", options->changed_protocol,
                   "continue with a plan's protocol that was changed since earlier participants of "
                   "the group");
  command.add_flag("--again", options->again,
                   "repeat a protocol that the participant has finished; or use an id "
                   "that is similar to another's, as 1 and 01 are, or not in the plan");
  command.does([options] { run(*options); });
}

}  // namespace heft::cli
