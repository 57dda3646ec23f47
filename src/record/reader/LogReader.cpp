#include "record/reader/LogReader.h"

#include <SQLiteCpp/Backup.h>
#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>

#include <deque>
#include <type_traits>

#include "base/Error.h"
#include "record/file/Failures.h"
#include "record/file/LogFile.h"
#include "record/integrity/Seals.h"
#include "record/schema/Binding.h"
#include "record/schema/Cells.h"
#include "record/schema/Digests.h"
#include "record/schema/EventRow.h"
#include "record/schema/RowSql.h"
#include "record/schema/Schema.h"

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

// A row with a configuration, whose index follows the row's id.
template <typename Row>
Row setup_row_from(Cells& cells) {
  const int setup_index = cells.integer();
  Row row = row_from<Row>(cells);
  row.setup_index = setup_index;
  return row;
}

template <typename Row>
std::string with_setups(std::string_view table) {
  return fmt::format(
      "SELECT rowid, ifnull((SELECT setup_index FROM setup s WHERE s.setup_id = t.setup_id AND "
      "s.session_id = t.session_id), 0), {} FROM {} t WHERE session_id = ? ORDER BY rowid",
      columns_of<Row>(), table);
}
}  // namespace

class LogReader::Impl {
 public:
  explicit Impl(const std::string& path) : path_(path), database_(open_for_reading(path)) {
    try {
      has_tables_ = holds_log(*database_, path_);
      if (!has_tables_) return;
      // All reads see one snapshot: a transaction that the first read starts.
      database_->exec("BEGIN");
      database_->execAndGet("SELECT count(*) FROM session");
    } catch (const SQLite::Exception& error) {
      refuse_damaged("the sessions", error);
    }
  }

  /// Converts every row of a query with `make`. The first column is the row's id.
  template <typename Make, typename... Values>
  auto rows(const Make& make, std::string_view table, const std::string& sql,
            const Values&... values) const try {
    std::vector<std::invoke_result_t<Make, Cells&>> found;
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
    return heft::first_broken_digest(*database_, path_, session_id);
  } catch (const SQLite::Exception& error) {
    refuse_damaged("the digests", error);
  }

  std::vector<Seal> seals() const try {
    return has_tables_ ? seals_in(*database_) : std::vector<Seal>{};
  } catch (const SQLite::Exception& error) {
    refuse_damaged("the seals", error);
  }

  /// Head of the last seal that satisfies an SQL condition; empty: there is none.
  template <typename... Values>
  std::string head(std::string_view condition, const Values&... values) const {
    const auto heads =
        rows([](Cells& cells) { return cells.text(); }, "seal",
             fmt::format("SELECT seal_id, head FROM seal WHERE {} ORDER BY seal_id DESC LIMIT 1",
                         condition),
             values...);
    return heads.empty() ? "" : heads.front();
  }

  std::optional<BrokenDigest> first_broken_seal() const try {
    return has_tables_ ? heft::first_broken_seal(*database_) : std::nullopt;
  } catch (const SQLite::Exception& error) {
    refuse_damaged("the seals", error);
  }

  std::vector<SessionRow> sessions(const std::string& condition) const {
    return with_participant_info(rows(session_from, "session", session_sql(condition)));
  }

  /// A session's events that satisfy an SQL condition.
  std::vector<LoggedEvent> events(std::int64_t session_id, std::string_view condition) const {
    std::vector<LoggedEvent> events;
    for (const EventRow& row :
         rows(attempt_row_from<EventRow>, "event",
              in_session("event", "event_id", columns_of<EventRow>(), condition), session_id))
      events.push_back({event_of(row), row.attempt_index});
    return events;
  }

  /// Adds participant_info. @throws Error for a session of a version that is not supported
  std::vector<SessionRow> with_participant_info(std::vector<SessionRow> sessions) const {
    for (SessionRow& session : sessions) {
      if (session.header.log_version < oldest_log_version)
        throw Error(fmt::format(
            "{}: session {} was recorded in version {} of the log; heft {} reads versions {} to "
            "{}. Use the version of heft that recorded it.",
            path_, session.session_id, session.header.log_version, HEFT_VERSION, oldest_log_version,
            current_log_version));
      for (const auto& [key, value] :
           rows(info_from, "participant_info",
                "SELECT rowid, key, value FROM participant_info WHERE session_id = ?",
                session.session_id))
        session.header.participant_info[key] = value;
    }
    return sessions;
  }

  static std::string session_sql(const std::string& condition) {
    return fmt::format("SELECT session_id, {}, state FROM session WHERE {} ORDER BY session_id",
                       columns_of<SessionHeader>(), condition);
  }

  [[noreturn]] void refuse_unknown(std::int64_t session_id) const {
    throw Error(fmt::format("{} has no session {}", path_, session_id));
  }

 private:
  [[noreturn]] void refuse_damaged(const std::string& part, const SQLite::Exception& error) const {
    throw sqlite_error(fmt::format("cannot read {} of {}", part, path_), error, database_.get());
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

std::vector<std::int64_t> LogReader::session_ids() const {
  return impl_->rows([](Cells& cells) { return cells.id(); }, "session",
                     "SELECT session_id FROM session ORDER BY session_id");
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
  return impl_->events(session(session_id).session_id, "true");
}

std::vector<LoggedEvent> LogReader::events(std::int64_t session_id,
                                           std::span<const EventKind> kinds) const {
  std::string names;
  for (const EventKind kind : kinds)
    names += fmt::format("{}'{}'", names.empty() ? "" : ", ", name_of(kind));
  return impl_->events(session(session_id).session_id, fmt::format("kind IN ({})", names));
}

std::vector<LoggedSetup> LogReader::setups(std::int64_t session_id) const {
  // The contents of files are in the events.
  std::deque<SessionConfig> logged_events;
  for (const LoggedEvent& logged : impl_->events(session(session_id).session_id, "kind = 'setup'"))
    if (const auto* setup = logged.event.as<SessionConfig>()) logged_events.push_back(*setup);
  const auto setup_from = [&](Cells& cells) {
    LoggedSetup logged{cells.integer(), cells.integer(), {}};
    if (!logged_events.empty()) {
      logged.setup = std::move(logged_events.front());
      logged_events.pop_front();
    }
    visit_columns(logged.setup, FillRow(cells));
    return logged;
  };
  return impl_->rows(
      setup_from, "setup",
      fmt::format(
          "SELECT setup_id, setup_index, (SELECT count(*) FROM event e WHERE e.session_id = "
          "?1 AND e.event_id <= from_event_id), {} FROM setup WHERE session_id = ?1 ORDER "
          "BY setup_index",
          columns_of<SessionConfig>()),
      session_id);
}

std::vector<TrialRow> LogReader::trials(std::int64_t session_id) const {
  auto trials =
      impl_->rows(setup_row_from<TrialRow>, "trial", with_setups<TrialRow>("trial"), session_id);
  std::map<int, std::vector<CubeRow>> shown;
  for (const CubeRow& cube : cubes(session_id)) shown[cube.attempt_index].push_back(cube);
  for (TrialRow& trial : trials)
    for (const CubeRow& cube : shown[trial.attempt_index]) {
      trial.plan.masses_g.push_back(cube.mass_g);
      if (cube.table_friction) trial.plan.table_friction.push_back(*cube.table_friction);
    }
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

std::vector<ParticipantParameterRow> LogReader::participant_parameters(
    std::int64_t session_id) const {
  return impl_->rows(setup_row_from<ParticipantParameterRow>, "participant_parameter",
                     with_setups<ParticipantParameterRow>("participant_parameter"), session_id);
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

FrameCounts LogReader::frame_counts(std::int64_t session_id) const {
  const auto counts_from = [](Cells& cells) {
    FrameCounts counts;
    cells.read(counts.n_frames);
    cells.read(counts.n_tracked);
    cells.read(counts.n_jumps);
    cells.read(counts.mean_quality);
    return counts;
  };
  const auto counts = impl_->rows(
      counts_from, "frame",
      "SELECT 0, count(*), coalesce(sum(tracked), 0), coalesce(sum(jump), 0), avg(quality) "
      "FROM frame WHERE trial_id IN (SELECT trial_id FROM trial WHERE session_id = ?1)",
      session_id);
  return counts.empty() ? FrameCounts{} : counts.front();
}

std::map<std::pair<int, int>, double> LogReader::clone_yaw_deg(std::int64_t session_id) const {
  using Turn = std::pair<std::pair<int, int>, double>;
  const auto turn_from = [](Cells& cells) {
    Turn turn;
    cells.read(turn.first.first);
    cells.read(turn.first.second);
    cells.read(turn.second);
    return turn;
  };
  const auto turns = impl_->rows(
      turn_from, "frame",
      fmt::format(
          "SELECT 0, t.attempt_index, f.contact_slot, max(abs({})) FROM trial t JOIN frame f "
          "ON f.trial_id = t.trial_id WHERE t.session_id = ?1 AND f.contact_slot IS NOT NULL "
          "AND f.clone_qw IS NOT NULL GROUP BY t.attempt_index, f.contact_slot",
          schema::clone_yaw_deg_sql),
      session_id);
  return {turns.begin(), turns.end()};
}

std::vector<Seal> LogReader::seals() const {
  return impl_->seals();
}

std::string LogReader::head() const {
  return impl_->head("TRUE");
}

std::string LogReader::head_of(std::int64_t session_id) const {
  return impl_->head("session_id = ?", session_id);
}

std::optional<BrokenDigest> LogReader::first_broken_seal() const {
  return impl_->first_broken_seal();
}

std::vector<std::string> LogReader::foreign_objects() const {
  return impl_->foreign_objects();
}

std::optional<BrokenDigest> LogReader::first_broken_digest(std::int64_t session_id) const {
  return impl_->first_broken_digest(session_id);
}

namespace {
void add_page_and_rule_faults(SQLite::Database& database, std::vector<std::string>& faults) {
  SQLite::Statement query(database, "PRAGMA integrity_check");
  while (query.executeStep()) {
    const std::string fault = query.getColumn(0).getString();
    if (fault != "ok") faults.push_back(fault);
  }
}

void add_reference_faults(SQLite::Database& database, std::vector<std::string>& faults) {
  SQLite::Statement query(database, "PRAGMA foreign_key_check");
  while (query.executeStep())
    faults.push_back(fmt::format("table {}, row {}: refers to a missing row of {}",
                                 query.getColumn(0).getString(), query.getColumn(1).getString(),
                                 query.getColumn(2).getString()));
}
}  // namespace

std::vector<std::string> check_integrity(const std::string& path) {
  const auto database = open_for_reading(path);
  std::vector<std::string> faults;
  try {
    holds_log(*database, path);
    // A read-only connection does not check constraints, so a temporary copy is checked.
    SQLite::Database copy("", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    distrust(copy);
    SQLite::Backup(copy, *database).executeStep();
    add_page_and_rule_faults(copy, faults);
    add_reference_faults(copy, faults);
  } catch (const SQLite::Exception& error) {
    faults.push_back(error.what());
  }
  return faults;
}

}  // namespace heft
