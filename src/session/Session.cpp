#include "session/Session.h"

#include <fmt/format.h>

#include <filesystem>
#include <random>

#include "apparatus/EventOutlet.h"
#include "base/Clock.h"
#include "base/Error.h"
#include "base/Program.h"
#include "base/files/Printable.h"
#include "record/schema/EventRow.h"
#include "record/writer/SessionLog.h"
#include "replay/Replay.h"
#include "session/Equipment.h"

namespace heft {

namespace fs = std::filesystem;

namespace {

// Protects participants' data against slips: an unfinished session is resumed, a finished one is
// repeated only with --again. Of two programs that start simultaneously only one gets the log's
// lock.
void refuse_repetition(const SessionRequest& request) {
  refuse_special_file(request.db);
  std::error_code unknown;  // unreadable files are reported when opened for writing
  if (!fs::exists(request.db, unknown)) return;
  for (const SessionRow& session :
       LogReader(request.db).sessions_of(request.participant, request.config->protocol->name)) {
    if (is_unfinished(session.state))
      throw Error(fmt::format("participant {} has an unfinished session of {} in {}; continue "
                              "it: heft resume --db {} --session {}",
                              request.participant, request.config->protocol->name, request.db,
                              shell_quoted(request.db), session.session_id),
                  ExitCode::usage);
    if (!request.again)
      throw Error(fmt::format("participant {} has {} {} in {} (session {}); to repeat it "
                              "on purpose add --again",
                              request.participant,
                              session.state == SessionState::finished ? "finished" : "ended",
                              request.config->protocol->name, request.db, session.session_id),
                  ExitCode::usage);
  }
}

// The `session` row of a request that starts now.
SessionHeader header_with(const SessionRequest& request, const SessionConfig& setup) {
  SessionHeader header;
  header.participant = request.participant;
  header.protocol_name = request.config->protocol->name;
  header.protocol_text = request.config->protocol->text;
  header.protocol_sha256 = request.config->protocol->sha256;
  header.seed = request.config->seed;
  header.heft_version = HEFT_VERSION;
  header.build = build_name();
  header.run_options = to_json(setup);
  header.purpose = has_person(setup) ? request.purpose : Purpose::simulated;
  header.responder = to_text(setup.responder);
  header.started_utc = request.started_utc.empty() ? utc_now() : request.started_utc;
  header.participant_info = request.participant_info;
  return header;
}

RunEnd run_with(Equipment& equipment, Engine& engine, EventSink& sink, const RunnerOptions& runner,
                double start_s, ResumeState before = {}) {
  equipment.clock.restart(start_s);
  SessionParts parts = equipment.parts(engine, sink);
  parts.before = std::move(before);
  return Runner(parts, runner).run();
}

// Everything is on disk, and a session that ended is sealed. If another process locks the database
// when a session is left, the next one seals it.
// @return the log's head; empty if it is locked
std::string sealed(SessionLog& log) try { return log.seal(); } catch (const LogBusy&) {
  return "";
}

// Fails if the file was moved or deleted.
SessionResult close(const Engine& engine, RunEnd end, SessionLog& log, EventSink& sink,
                    std::optional<AnnouncingSink>& announcing) {
  sink.flush();
  const std::string head = sealed(log);
  if (announcing && !head.empty()) announcing->announce_head(engine.last_s(), head);
  return {end, log.session_id(), engine.last_s(), engine.n_completed(), head};
}

// New events must follow an unchanged log.
void refuse_changed_log(const LogReader& reader, const LoggedSession& session) {
  std::string why;
  if (const auto fault = fault_of_structure(reader))
    why = *fault;
  else if (const Verification found = verify_rows(reader, session.row.session_id); found.first)
    why = fmt::format("{} is {}, but its events give {}", found.first->what, found.first->logged,
                      found.first->replayed);
  if (why.empty()) return;
  if (const auto damage = check_integrity(session.db); !damage.empty())
    throw Error(
        fmt::format("session {} in {} cannot be continued: the file is damaged ({}). Keep a "
                    "copy of it and of the files beside it that end in -wal and -shm, and continue "
                    "with a backup.",
                    session.row.session_id, session.db, damage.front()),
        ExitCode::diverged);
  throw Error(fmt::format("session {} in {} cannot be continued: the log was changed; {}. "
                          "Inspect it with: heft replay --db {} --session {}",
                          session.row.session_id, session.db, why, shell_quoted(session.db),
                          session.row.session_id),
              ExitCode::diverged);
}

// A logged session folded up to its last event, under the log's lock.
struct Reopened {
  explicit Reopened(const LoggedSession& session)
      : log(SessionLog::reopen(session.db, session.row.session_id)),
        engine(session.protocol, session.row.header.seed) {
    const LogReader reader(session.db);
    refuse_changed_log(reader, session);
    for (const LoggedEvent& logged : reader.events(session.row.session_id)) {
      engine.apply(logged.event);
      events.push_back(logged.event);
    }
  }
  void append(const Event& event) {
    sink->append(event, engine.apply(event), Durability::buffered);
  }
  void close_attempt(std::string_view why) {
    if (engine.trial_is_open()) append({engine.last_s(), TrialVoided{std::string(why)}});
  }

  SessionLog log;
  EventSink* sink = &log;
  Engine engine;
  std::vector<Event> events;
};

// The log itself, or the log with its announcements.
EventSink& heard_by_others(std::optional<AnnouncingSink>& announcing, SessionLog& log,
                           const RunnerOptions& runner, const std::string& participant) {
  if (!runner.events) return log;
  return announcing.emplace(log, *runner.events, log.session_id(), participant);
}

// The configuration in effect from here on.
void log_config(Engine& engine, EventSink& sink, const SessionConfig& setup) {
  const Event event{engine.last_s(), setup};
  sink.append(event, engine.apply(event), Durability::buffered);
}

}  // namespace

std::uint64_t fresh_seed() {
  std::random_device device;
  return ((std::uint64_t{device()} << 32) | device()) >> 1;
}

void refuse_special_file(const std::string& db) {
  std::error_code unknown;
  const auto status = fs::status(db, unknown);
  if (!fs::exists(status) || fs::is_regular_file(status) ||
      fs::is_directory(status))  // a folder is reported when opened
    return;
  throw Error(
      fmt::format("{} is a device, pipe or socket, expected a log file. Choose another "
                  "file with --db FILE.",
                  db));
}

SessionResult start_session(const SessionRequest& request, const RunnerOptions& runner) {
  refuse_repetition(request);
  Equipment equipment(request.config);
  const SessionConfig setup = equipment.logged_config();
  Engine engine(request.config->protocol, request.config->seed);
  const Event event{0, setup};
  const RecordedEvent first{event, engine.apply(event)};
  SessionLog log = SessionLog::start(request.db, header_with(request, setup), first);
  if (runner.begun) *runner.begun = log.session_id();
  std::optional<AnnouncingSink> announcing;
  EventSink& sink = heard_by_others(announcing, log, runner, request.participant);
  if (announcing) announcing->announce(first.event, first.changes);
  const RunEnd end = run_with(equipment, engine, sink, runner, 0);
  return close(engine, end, log, sink, announcing);
}

LoggedSession session_to_resume(const std::string& db, std::optional<std::int64_t> session_id) {
  refuse_special_file(db);
  const LogReader reader(db);
  if (!session_id) {
    const auto row = reader.newest_unfinished_session();
    if (!row)
      throw Error(
          fmt::format("{} holds no unfinished session; start one: heft run PROTOCOL "
                      "--participant ID --db {}",
                      db, shell_quoted(db)));
    session_id = row->session_id;
  } else if (const SessionState state = reader.session(*session_id).state; !is_unfinished(state)) {
    throw Error(fmt::format("session {} in {} is {}; there is nothing to resume", *session_id, db,
                            name_of(state)));
  }
  LoggedSession session = load_session(reader, db, *session_id);
  refuse_changed_log(reader, session);  // before any path that it holds is opened
  return session;
}

SessionResult resume_session(const LoggedSession& session, const ResolvedConfig& config,
                             const RunnerOptions& runner) {
  Equipment equipment(config);
  Reopened reopened(session);
  if (runner.begun) *runner.begun = session.row.session_id;
  std::optional<AnnouncingSink> announcing;
  EventSink& sink =
      heard_by_others(announcing, reopened.log, runner, session.row.header.participant);
  reopened.sink = &sink;
  const double last_s = reopened.engine.last_s();
  reopened.close_attempt(void_interrupted);
  const double now_s = log_time(std::max(last_s, seconds_since(session.row.header.started_utc)));
  reopened.append({now_s, SessionResumed{utc_now(), now_s - last_s}});
  if (const SessionConfig setup = equipment.logged_config(); setup != session.setups.back().setup)
    log_config(reopened.engine, sink, setup);
  sink.flush();  // the whole resumption or nothing
  const RunEnd end = run_with(equipment, reopened.engine, sink, runner, now_s,
                              resume_state(reopened.events, session.row.header.participant_info));
  return close(reopened.engine, end, reopened.log, sink, announcing);
}

void abort_session(const LoggedSession& session) {
  Reopened reopened(session);
  reopened.close_attempt("aborted");
  reopened.append({reopened.engine.last_s(), SessionEnded{Ending::aborted}});
  reopened.log.flush();
  sealed(reopened.log);
}

SessionHeader header_of(const SessionRequest& request) {
  return header_with(request, Equipment(request.config).logged_config());
}

RecordedSession compute_session(const SessionRequest& request, const RunnerOptions& runner) {
  Equipment equipment(request.config);
  const SessionConfig setup = equipment.logged_config();
  RecordedSession recorded(header_with(request, setup));
  Engine engine(request.config->protocol, request.config->seed);
  log_config(engine, recorded, setup);
  run_with(equipment, engine, recorded, runner, 0);
  return recorded;
}

}  // namespace heft
