#include "session/Session.h"

#include <fmt/format.h>

#include <filesystem>
#include <random>

#include "base/Build.h"
#include "base/Error.h"
#include "base/Printable.h"
#include "record/LogReader.h"
#include "record/SessionLog.h"
#include "session/Equipment.h"
#include "session/NextPart.h"

namespace heft {

namespace {

// A participant's data is never mixed up by a slip: an unfinished session is resumed, a finished
// one repeated only on purpose. Of two programs that come through here at once only one gets the
// log's lock.
void refuse_repetition(const SessionRequest& request) {
  refuse_special_file(request.db);
  std::error_code unknown;  // what can't be looked at is explained when it is opened for writing
  if (!std::filesystem::exists(request.db, unknown)) return;
  for (const SessionRow& session :
       LogReader(request.db).sessions_of(request.participant, request.protocol.name)) {
    if (is_unfinished(session.state))
      throw Error(fmt::format("participant {} has an unfinished session of {} in {}; go on with "
                              "it: heft resume --db {} --session {}",
                              request.participant, request.protocol.name, request.db,
                              shell_quoted(request.db), session.session_id),
                  ExitCode::usage);
    if (!request.again)
      throw Error(fmt::format("participant {} has {} {} in {} (session {}); to run it once "
                              "more on purpose add --again",
                              request.participant,
                              session.state == SessionState::finished ? "finished" : "ended",
                              request.protocol.name, request.db, session.session_id),
                  ExitCode::usage);
  }
}

// What `auto` is, once: the header says it and the trials run with it.
SessionRequest resolved(SessionRequest request) {
  request.options = with_auto_resolved(std::move(request.options), request.protocol);
  return request;
}

// The `session` row of a request that starts now.
SessionHeader header_of(const SessionRequest& request) {
  SessionHeader header;
  header.participant = request.participant;
  header.protocol_name = request.protocol.name;
  header.protocol_text = request.protocol.text;
  header.protocol_sha256 = request.protocol.sha256;
  header.seed = request.seed;
  header.heft_version = HEFT_VERSION;
  header.build = build_name();
  header.run_options = to_json(request.options);
  header.purpose = has_person(request.options) ? request.purpose : "simulated";
  header.responder = request.options.responder;
  header.started_utc = utc_now();
  return header;
}

RunEnd run_with(Equipment& equipment, Engine& engine, EventSink& sink, const RunnerOptions& runner,
                double start_s) {
  equipment.clock.restart(start_s);
  return Runner(equipment.parts(engine, sink), runner).run();
}

SessionResult result_of(const Engine& engine, RunEnd end, std::int64_t session_id) {
  return {end, session_id, engine.last_s(), engine.n_completed()};
}

Event plain_event(double t_s, EventKind kind, std::string detail) {
  Event event;
  event.t_s = t_s;
  event.kind = kind;
  event.detail = std::move(detail);
  return event;
}

// A logged session folded up to its last event, with nobody else writing.
struct Reopened {
  explicit Reopened(const LoggedSession& session)
      : log(SessionLog::reopen(session.db, session.row.session_id)),
        engine(session.protocol, session.row.header.seed) {
    for (const LoggedEvent& logged : LogReader(session.db).events(session.row.session_id))
      engine.apply(logged.event);
  }
  void append(const Event& event) { log.append(event, engine.apply(event), Durability::buffered); }
  void close_attempt(const std::string& why) {
    if (engine.trial_is_open()) append(plain_event(engine.last_s(), EventKind::voided, why));
  }

  SessionLog log;
  Engine engine;
};

// With the options that were given again when it was resumed before.
LoggedSession load_unfinished(const LogReader& reader, const std::string& db,
                              std::int64_t session_id) {
  LoggedSession session = load_session(reader, db, session_id);
  for (const LoggedEvent& logged : reader.events(session_id))
    if (logged.event.kind == EventKind::deviation)
      apply_deviation(session.options, logged.event.detail);
  return session;
}

}  // namespace

std::uint64_t fresh_seed() {
  std::random_device device;
  return ((std::uint64_t{device()} << 32) | device()) >> 1;
}

void refuse_special_file(const std::string& db) {
  std::error_code unknown;
  const auto status = std::filesystem::status(db, unknown);
  if (!std::filesystem::exists(status) || std::filesystem::is_regular_file(status) ||
      std::filesystem::is_directory(status))  // a folder is explained when it is opened
    return;
  throw Error(
      fmt::format("{} is a device, pipe or socket, expected a log file. Choose another "
                  "file with --db FILE.",
                  db));
}

SessionResult start_session(const SessionRequest& asked_for, const RunnerOptions& runner) {
  refuse_repetition(asked_for);
  const SessionRequest request = resolved(asked_for);
  const auto protocol = protocol_for(request.protocol, request.options);
  Equipment equipment(protocol, request.options, request.seed);
  SessionLog log = SessionLog::start(request.db, header_of(request));
  Engine engine(protocol, request.seed);
  const RunEnd end = run_with(equipment, engine, log, runner, 0);
  log.flush();  // it is still where it is thought to be
  return result_of(engine, end, log.session_id());
}

LoggedSession load_session(const LogReader& reader, const std::string& db,
                           std::int64_t session_id) {
  LoggedSession session;
  session.db = db;
  session.row = reader.session(session_id);
  const SessionHeader& header = session.row.header;
  session.options = run_options_from_json(header.run_options);
  Protocol protocol = parse_protocol(header.protocol_text, header.protocol_name);
  protocol.name = header.protocol_name;
  session.protocol = protocol_for(std::move(protocol), session.options);
  return session;
}

LoggedSession session_to_resume(const std::string& db, std::optional<std::int64_t> session_id) {
  refuse_special_file(db);
  const LogReader reader(db);
  if (session_id) {
    const SessionState state = reader.session(*session_id).state;
    if (!is_unfinished(state))
      throw Error(fmt::format("session {} in {} is {}; there is nothing to go on with", *session_id,
                              db, name_of(state)));
    return load_unfinished(reader, db, *session_id);
  }
  if (const auto row = reader.newest_unfinished_session())
    return load_unfinished(reader, db, row->session_id);
  throw Error(
      fmt::format("{} holds no unfinished session; start one: heft run PROTOCOL "
                  "--participant ID --db {}",
                  db, shell_quoted(db)));
}

void give_again(LoggedSession& session, const GivenOptions& again) {
  const std::string& simulator = session.protocol->simulator.name;
  const bool as_asked_for = again.simulator && !session.options.auto_simulator.empty() &&
                            is_same_simulator(*again.simulator, "auto");
  if (again.simulator && !as_asked_for && !is_same_simulator(*again.simulator, simulator))
    throw Error(fmt::format("session {} runs with the simulator {}, and replay checks a whole "
                            "session with one; go on without --simulator {}",
                            session.row.session_id, simulator, *again.simulator),
                ExitCode::usage);
  RunOptions options = session.options;
  if (again.tracker) options.tracker = *again.tracker;
  if (again.view) options.view = *again.view;
  if (again.camera_file) options.camera_file = *again.camera_file;
  if (again.board_file) options.board_file = *again.board_file;
  if (again.effector_file) options.effector_file = *again.effector_file;
  if (again.responder) options.responder = *again.responder;
  const bool as_before = !again.responder && !again.tracker && !again.camera_file &&
                         !again.board_file && !again.effector_file;
  if (as_before)
    check(options);
  else
    complete(options);
  session.changes = changes_between(session.options, options);
  session.options = options;
}

SessionResult resume_session(const LoggedSession& session, const RunnerOptions& runner) {
  Equipment equipment(session.protocol, with_next_parts(session.options), session.row.header.seed);
  Reopened reopened(session);
  const double last_s = reopened.engine.last_s();
  reopened.close_attempt(std::string(void_interrupted));
  const double now_s = log_time(std::max(last_s, seconds_since(session.row.header.started_utc)));
  Event resumed = plain_event(now_s, EventKind::resumed, utc_now());
  resumed.value = now_s - last_s;
  reopened.append(resumed);
  for (const OptionChange& change : session.changes)
    reopened.append(plain_event(now_s, EventKind::deviation, to_json(change)));
  reopened.log.flush();  // all of the return or nothing of it
  const RunEnd end = run_with(equipment, reopened.engine, reopened.log, runner, now_s);
  reopened.log.flush();
  return result_of(reopened.engine, end, session.row.session_id);
}

void abort_session(const LoggedSession& session) {
  Reopened reopened(session);
  reopened.close_attempt("aborted");
  reopened.append(plain_event(reopened.engine.last_s(), EventKind::ended, "aborted"));
  reopened.log.flush();
}

RecordedSession compute_session(const SessionRequest& asked_for, const RunnerOptions& runner) {
  const SessionRequest request = resolved(asked_for);
  RecordedSession recorded(header_of(request));
  const auto protocol = protocol_for(request.protocol, request.options);
  Equipment equipment(protocol, request.options, request.seed);
  Engine engine(protocol, request.seed);
  run_with(equipment, engine, recorded, runner, 0);
  return recorded;
}

}  // namespace heft
