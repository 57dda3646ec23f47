#include "record/LogReader.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>

#include "base/Error.h"
#include "record/Binding.h"
#include "record/DigestCheck.h"
#include "record/EventRow.h"
#include "record/LogFile.h"
#include "record/OlderSetups.h"
#include "record/ReadOnlyDatabase.h"
#include "record/RowQueries.h"
#include "record/RowSql.h"
#include "record/RowVisitors.h"
#include "record/Schema.h"
#include "record/SqliteError.h"

namespace heft {

namespace {
SessionRow session_from(Cells& cells) {
  SessionRow row;
  row.session_id = cells.id();
  row.header = row_from<SessionHeader>(cells);
  row.state = cells.name<SessionState>();
  return row;
}

std::pair<std::string, std::string> info_from(Cells& cells) {
  std::string key = cells.text();
  return {std::move(key), cells.text()};
}

LoggedSetup setup_from(Cells& cells) {
  LoggedSetup logged;
  logged.setup_index = cells.integer();
  logged.from_event = cells.integer();
  logged.setup = row_from<Setup>(cells);
  return logged;
}

TrialRow trial_from(Cells& cells) {
  const int setup_index = cells.integer();
  TrialRow row = row_from<TrialRow>(cells);
  row.setup_index = setup_index;
  return row;
}
}  // namespace

class LogReader::Impl {
 public:
  explicit Impl(const std::string& path) : path_(path), database_(open_for_reading(path)) {
    has_tables_ = holds_log(*database_, path_);
    if (!has_tables_) return;
    // One moment for all reads: a transaction that the first of them opens.
    database_->exec("BEGIN");
    database_->execAndGet("SELECT count(*) FROM session");
  }

  /// Every row of a query, made into a value by `make`. The query's first column is the row's id.
  template <typename Row, typename... Values>
  std::vector<Row> rows(Row (*make)(Cells&), std::string_view table, const std::string& sql,
                        const Values&... values) const try {
    std::vector<Row> found;
    if (!has_tables_) return found;
    SQLite::Statement query(*database_, sql);
    Binding binding(query, values...);
    while (binding.step()) {
      Cells cells(query, path_, table);
      found.push_back(make(cells));
    }
    return found;
  } catch (const SQLite::Exception& error) {
    refuse_damaged(fmt::format("table {}", table), error);
  }

  std::vector<std::string> foreign_objects() const {
    return has_tables_ ? schema::foreign_objects(*database_) : std::vector<std::string>{};
  }

  std::optional<BrokenDigest> first_broken_digest(std::int64_t session_id) const try {
    if (!has_tables_) refuse_unknown(session_id);
    return DigestCheck(*database_, path_, session_id).first_broken();
  } catch (const SQLite::Exception& error) {
    refuse_damaged("the digests", error);
  }

  std::vector<SessionRow> sessions(const std::string& condition) const {
    return with_participant_info(rows(session_from, "session", session_sql(condition)));
  }

  std::vector<SessionRow> with_participant_info(std::vector<SessionRow> sessions) const {
    for (SessionRow& session : sessions)
      for (const auto& [key, value] :
           rows(info_from, "participant_info",
                "SELECT rowid, key, value FROM participant_info WHERE session_id = ?",
                session.session_id))
        session.header.participant_info[key] = value;
    return sessions;
  }

  static std::string session_sql(const std::string& condition) {
    return fmt::format("SELECT session_id, {}, state FROM session WHERE {} ORDER BY session_id",
                       columns_of<SessionHeader>(), condition);
  }

  [[noreturn]] void refuse_unknown(std::int64_t session_id) const {
    throw Error(fmt::format("{} holds no session {}", path_, session_id));
  }

 private:
  [[noreturn]] void refuse_damaged(const std::string& part, const SQLite::Exception& error) const {
    const SqliteFailure failure = explained(error, database_.get());
    throw Error(
        fmt::format("can't read {} of {}: {}. {}.", part, path_, failure.reason, failure.advice));
  }

  std::string path_;
  std::unique_ptr<SQLite::Database> database_;
  bool has_tables_ = false;
};

LogReader::LogReader(const std::string& path) : impl_(std::make_unique<Impl>(path)) {}
LogReader::LogReader(LogReader&&) noexcept = default;
LogReader& LogReader::operator=(LogReader&&) noexcept = default;
LogReader::~LogReader() = default;

std::vector<SessionRow> LogReader::sessions() const {
  return impl_->sessions("true");
}

SessionRow LogReader::session(std::int64_t session_id) const {
  const auto found = impl_->with_participant_info(
      impl_->rows(session_from, "session", Impl::session_sql("session_id = ?1"), session_id));
  if (found.empty()) impl_->refuse_unknown(session_id);
  return found.front();
}

std::vector<SessionRow> LogReader::sessions_of(const std::string& participant,
                                               const std::string& protocol_name) const {
  return impl_->with_participant_info(impl_->rows(
      session_from, "session", Impl::session_sql("participant = ?1 AND protocol_name = ?2"),
      participant, protocol_name));
}

std::optional<SessionRow> LogReader::newest_unfinished_session() const {
  auto unfinished = impl_->sessions("state IN ('running', 'paused')");
  if (unfinished.empty()) return std::nullopt;
  return std::move(unfinished.back());
}

std::vector<LoggedEvent> LogReader::events(std::int64_t session_id) const {
  std::vector<LoggedEvent> events;
  std::optional<Setup> older;  // in force so far, where events did not tell it
  if (const SessionRow row = session(session_id); row.header.log_version < 3)
    older = older_setup(row.header);
  for (const EventRow& row :
       impl_->rows(attempt_row_from<EventRow>, "event",
                   in_session("event", "event_id", columns_of<EventRow>()), session_id)) {
    LoggedEvent logged{event_of(row), row.attempt_index};
    if (const auto* told = logged.event.as<Setup>(); told && older) older = *told;
    if (const auto* deviation = logged.event.as<Deviation>(); deviation && older)
      if (const auto after = after_deviation(*older, deviation->text))
        logged.event.what = *(older = after);
    events.push_back(std::move(logged));
  }
  return events;
}

std::vector<LoggedSetup> LogReader::setups(std::int64_t session_id) const {
  auto setups = impl_->rows(
      setup_from, "setup",
      fmt::format(
          "SELECT setup_id, setup_index, (SELECT count(*) FROM event e WHERE e.session_id = "
          "?1 AND e.event_id <= from_event_id), {} FROM setup WHERE session_id = ?1 ORDER "
          "BY setup_index",
          columns_of<Setup>()),
      session_id);
  // Their files' contents stand in the events, or in an older session's header.
  std::size_t next = 0;
  const auto take_contents = [&](Setup from) {
    if (next == setups.size()) return;
    Setup& to = setups[next++].setup;
    std::vector<std::string> contents;
    visit_contents(from, [&](std::string_view, std::string& text) { contents.push_back(text); });
    auto text = contents.begin();
    visit_contents(to, [&](std::string_view, std::string& held) { held = *text++; });
  };
  if (const SessionRow row = session(session_id); row.header.log_version < 3)
    take_contents(older_setup(row.header));
  for (const LoggedEvent& logged : events(session_id))
    if (const auto* setup = logged.event.as<Setup>()) take_contents(*setup);
  return setups;
}

std::vector<TrialRow> LogReader::trials(std::int64_t session_id) const {
  auto trials = impl_->rows(
      trial_from, "trial",
      fmt::format("SELECT trial_id, ifnull((SELECT setup_index FROM setup s WHERE s.setup_id = "
                  "t.setup_id AND s.session_id = t.session_id), 0), {} FROM trial t WHERE "
                  "session_id = ? ORDER BY trial_id",
                  columns_of<TrialRow>()),
      session_id);
  std::map<int, std::vector<double>> masses_g;
  for (const CubeRow& cube : cubes(session_id)) masses_g[cube.attempt_index].push_back(cube.mass_g);
  for (TrialRow& trial : trials) trial.plan.masses_g = masses_g[trial.attempt_index];
  return trials;
}

std::vector<CubeRow> LogReader::cubes(std::int64_t session_id) const {
  return impl_->rows(attempt_row_from<CubeRow>, "cube",
                     in_trials("cube", "rowid", columns_of<CubeRow>()), session_id);
}

std::vector<AnswerRow> LogReader::answers(std::int64_t session_id) const {
  return impl_->rows(attempt_row_from<AnswerRow>, "answer",
                     in_trials("answer", "answer_id", columns_of<AnswerRow>()), session_id);
}

std::vector<ReversalRow> LogReader::reversals(std::int64_t session_id) const {
  return impl_->rows(attempt_row_from<ReversalRow>, "reversal",
                     in_session("reversal", "rowid", columns_of<ReversalRow>()), session_id);
}

std::vector<EstimateRow> LogReader::estimates(std::int64_t session_id) const {
  return impl_->rows(
      row_from<EstimateRow>, "estimate",
      fmt::format("SELECT rowid, {} FROM estimate WHERE session_id = ? ORDER BY rowid",
                  columns_of<EstimateRow>()),
      session_id);
}

std::vector<FrameRow> LogReader::frames(std::int64_t session_id, int attempt_index) const {
  const std::string of_attempt =
      attempt_index == 0 ? "trial_id IS NULL AND ?2 = 0"
                         : "trial_id = (SELECT trial_id FROM trial WHERE session_id = ?1 AND "
                           "attempt_index = ?2)";
  return impl_->rows(
      attempt_row_from<FrameRow>, "frame",
      fmt::format("SELECT frame_id, ?2 AS trial_id, {} FROM frame WHERE session_id = ?1 AND {} "
                  "ORDER BY frame_id",
                  columns_of<FrameRow>(), of_attempt),
      session_id, attempt_index);
}

std::vector<std::string> LogReader::foreign_objects() const {
  return impl_->foreign_objects();
}

std::optional<BrokenDigest> LogReader::first_broken_digest(std::int64_t session_id) const {
  return impl_->first_broken_digest(session_id);
}

}  // namespace heft
