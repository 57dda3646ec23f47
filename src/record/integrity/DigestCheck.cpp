#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>

#include <map>
#include <utility>

#include "base/Error.h"
#include "record/integrity/Seals.h"
#include "record/schema/Cells.h"
#include "record/schema/Digests.h"
#include "record/schema/EventRow.h"
#include "record/schema/RowSql.h"

namespace heft {

namespace {
// Column of the attempt index: after the row's id, before its cells and the digest.
constexpr int attempt_cell = 1;

template <typename Row>
int n_columns() {
  return static_cast<int>(sql_of<Row>().names.size());
}

bool is_earlier(const BrokenDigest& one, const BrokenDigest& other) {
  return one.t_s < other.t_s;
}

void set_place(BrokenDigest& broken, SQLite::Statement& query) {
  const SQLite::Column attempt = query.getColumn(attempt_cell);
  if (attempt.isInteger()) broken.attempt_index = attempt.getInt();
  broken.t_s = query.getColumn("t_s").getDouble();
}

std::string placed(const std::string& row, const BrokenDigest& at) {
  const std::string attempt =
      at.attempt_index > 0 ? fmt::format(" of attempt {}", at.attempt_index) : "";
  return fmt::format("{}{} at {:.3f} s", row, attempt, at.t_s);
}

void describe(BrokenDigest& broken, SQLite::Statement& query, const std::string& file) {
  const bool is_event = broken.table == "event";
  std::string row = is_event ? "the event" : "the frame";
  try {
    Cells cells(query, file, broken.table);
    if (is_event)
      row = description(event_of(attempt_row_from<EventRow>(cells)), std::nullopt);
    else
      attempt_row_from<FrameRow>(cells);
  } catch (const Error& error) {
    broken.damage = error.what();
  }
  broken.row = placed(row, broken);
}

class DigestCheck {
 public:
  DigestCheck(SQLite::Database& database, std::string file, std::int64_t session_id)
      : database_(database),
        file_(std::move(file)),
        session_id_(session_id),
        seals_(database, session_id) {}

  std::optional<BrokenDigest> first_broken();

 private:
  std::optional<BrokenDigest> broken_header();
  std::optional<BrokenDigest> broken_info();
  std::optional<BrokenDigest> broken_counts();
  std::optional<BrokenDigest> broken_event();
  std::optional<BrokenDigest> broken_frame();

  /// Adds cells of the query to the digest.
  void add_cells(SQLite::Statement& query, int first, int n);
  /// Compares the row's digest with the next of the chain, and advances the chain.
  std::optional<BrokenDigest> broken_link(SQLite::Statement& query, const std::string& table,
                                          int n_cells, std::string& chain);

  SQLite::Database& database_;
  std::string file_;
  std::int64_t session_id_;
  std::string start_;  ///< start of all chains
  RowDigest digest_;
  SealCheck seals_;
};

std::optional<BrokenDigest> DigestCheck::first_broken() {
  if (auto header = broken_header()) return header;
  if (auto info = broken_info()) return info;
  SQLite::Statement start(database_, chain_start_sql);
  start.bind(1, session_id_);
  start.executeStep();
  start_ = start.getColumn(0).getString();
  auto event = broken_event(), frame = broken_frame();
  if (!event && !frame) {
    auto counts = broken_counts();
    return counts ? counts : seals_.first_broken();
  }
  if (!event || (frame && is_earlier(*frame, *event))) return frame;
  return event;
}

std::optional<BrokenDigest> DigestCheck::broken_header() {
  SQLite::Statement query(
      database_,
      fmt::format("SELECT session_id, {}, state, digest FROM session WHERE session_id = ?1",
                  columns_of<SessionHeader>()));
  query.bind(1, session_id_);
  if (!query.executeStep()) throw Error(fmt::format("{} has no session {}", file_, session_id_));
  constexpr int first_header_cell = 1;
  static const int n_cells = n_columns<SessionHeader>();
  digest_.begin("session", "");
  add_cells(query, first_header_cell, n_cells);
  const std::string digest = digest_.value();
  BrokenDigest broken{"session", session_id_, 0, 0, query.getColumn("digest"), digest, {}, {}};
  broken.row = fmt::format("the header of session {}", session_id_);
  try {
    Cells cells(query, file_, "session");
    row_from<SessionHeader>(cells);
    cells.name<SessionState>();
  } catch (const Error& error) {
    broken.damage = error.what();
  }
  if (broken.logged == digest && broken.damage.empty()) return std::nullopt;
  return broken;
}

std::optional<BrokenDigest> DigestCheck::broken_info() {
  SQLite::Statement query(database_, "SELECT info_digest FROM session WHERE session_id = ?1");
  query.bind(1, session_id_);
  query.executeStep();
  BrokenDigest broken{"participant_info", session_id_, 0, 0, query.getColumn(0), {}, {}, {}};
  broken.recomputed = info_digest(database_, session_id_);
  broken.row = "the answers about the participant";
  if (broken.recomputed == broken.logged) return std::nullopt;
  return broken;
}

// A chain does not show that rows were removed from its end.
std::optional<BrokenDigest> DigestCheck::broken_counts() {
  SQLite::Statement query(
      database_,
      "SELECT n_events, n_frames, (SELECT count(*) FROM event WHERE session_id = ?1), (SELECT "
      "count(*) FROM frame WHERE session_id = ?1), (SELECT ifnull(max(t_s), 0) FROM event WHERE "
      "session_id = ?1) FROM session WHERE session_id = ?1");
  query.bind(1, session_id_);
  query.executeStep();
  const auto counts = [&](int first) {
    return fmt::format("{} events and {} frames", query.getColumn(first).getInt64(),
                       query.getColumn(first + 1).getInt64());
  };
  if (counts(0) == counts(2)) return std::nullopt;
  BrokenDigest broken{"session", session_id_, 0, query.getColumn(4), counts(0), counts(2), {}, {}};
  broken.row = "the session's number of rows";
  return broken;
}

std::optional<BrokenDigest> DigestCheck::broken_event() {
  SQLite::Statement query(database_,
                          in_session("event", "event_id", columns_of<EventRow>() + ", digest"));
  query.bind(1, session_id_);
  static const int n_cells = n_columns<EventRow>();
  std::string chain = start_;
  while (query.executeStep()) {
    if (auto broken = broken_link(query, "event", n_cells, chain)) return broken;
    seals_.event(chain);
  }
  return std::nullopt;
}

std::optional<BrokenDigest> DigestCheck::broken_frame() {
  SQLite::Statement query(database_, frames_in_session(columns_of<FrameRow>() + ", digest"));
  query.bind(1, session_id_);
  static const int n_cells = n_columns<FrameRow>();
  // By attempt; frames of a missing trial form a chain that matches no frame.
  std::map<std::string, std::optional<std::string>> chains;  // none: already broken
  std::optional<BrokenDigest> first;
  while (query.executeStep()) {
    const std::string attempt = query.getColumn(attempt_cell);
    auto& chain = chains.try_emplace(attempt, start_).first->second;
    if (!chain) continue;
    const auto broken = broken_link(query, "frame", n_cells, *chain);
    if (!broken) {
      seals_.frame(attempt, *chain);
      continue;
    }
    chain.reset();
    if (!first || is_earlier(*broken, *first)) first = broken;
  }
  return first;
}

void DigestCheck::add_cells(SQLite::Statement& query, int first, int n) {
  for (int i = first; i < first + n; ++i) digest_.cell(query.getColumn(i));
}

std::optional<BrokenDigest> DigestCheck::broken_link(SQLite::Statement& query,
                                                     const std::string& table, int n_cells,
                                                     std::string& chain) {
  const int last = query.getColumnCount() - 1;
  BrokenDigest broken{table, query.getColumn(0).getInt64(), 0, 0, query.getColumn(last), {}, {},
                      {}};
  digest_.begin(table, chain);
  add_cells(query, attempt_cell, 1 + n_cells);
  broken.recomputed = digest_.value();
  chain = broken.logged;
  if (broken.recomputed == broken.logged) return std::nullopt;
  set_place(broken, query);
  describe(broken, query, file_);
  return broken;
}
}  // namespace

std::optional<BrokenDigest> first_broken_digest(SQLite::Database& database, const std::string& file,
                                                std::int64_t session_id) {
  return DigestCheck(database, file, session_id).first_broken();
}

}  // namespace heft
