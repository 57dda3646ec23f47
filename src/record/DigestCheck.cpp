#include "record/DigestCheck.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>

#include <map>
#include <utility>

#include "base/Error.h"
#include "record/RowQueries.h"
#include "record/RowsFromCells.h"
#include "record/Schema.h"
#include "record/WriteFailure.h"

namespace heft {

namespace {
// Both: id, attempt, the row's own columns, digest.
std::string events_sql() {
  return in_session("event", "event_id", fmt::format("{}, digest", schema::event_columns));
}
std::string frames_sql(SQLite::Database& database) {
  return pictures_in_session(
      fmt::format("{}, {}, digest", schema::frame_columns, schema::frame_timing_in(database)));
}

// The row's last cell that its digest was taken over; see Schema.h, frame_timing_columns.
int last_digested(SQLite::Statement& query, const std::string& table) {
  const int last = query.getColumnCount() - 2;
  if (table != "frame") return last;
  for (int i = last; i > last - schema::n_frame_timing_columns; --i)
    if (!query.getColumn(i).isNull()) return last;
  return last - schema::n_frame_timing_columns;
}

bool is_earlier(const BrokenDigest& one, const BrokenDigest& other) {
  return one.t_s < other.t_s;
}

void set_place(BrokenDigest& broken, SQLite::Statement& query) {
  const SQLite::Column attempt = query.getColumn(1);
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
  std::string row = is_event ? "the event" : "the picture";
  try {
    Cells cells(query, file, broken.table);
    if (is_event)
      row = description(event_from(cells).event, std::nullopt);
    else
      frame_from(cells);
  } catch (const Error& error) {
    broken.damage = error.what();
  }
  broken.row = placed(row, broken);
}
}  // namespace

DigestCheck::DigestCheck(SQLite::Database& database, std::string file, std::int64_t session_id)
    : database_(database), file_(std::move(file)), session_id_(session_id) {}

std::optional<BrokenDigest> DigestCheck::first_broken() {
  if (auto header = broken_header()) return header;
  SQLite::Statement start(database_, chain_start_sql);
  start.bind(1, session_id_);
  start.executeStep();
  start_ = start.getColumn(0).getString();
  auto event = broken_event(), frame = broken_frame();
  if (!event || (frame && is_earlier(*frame, *event))) return frame;
  return event;
}

std::optional<BrokenDigest> DigestCheck::broken_header() {
  SQLite::Statement query(database_,
                          fmt::format("SELECT session_id, {}, state, digest FROM session WHERE "
                                      "session_id = ?1",
                                      schema::header_columns));
  query.bind(1, session_id_);
  if (!query.executeStep()) throw Error(fmt::format("{} holds no session {}", file_, session_id_));
  const int state = query.getColumnCount() - 2;  // the events tell it, and change it
  const std::string digest = recomputed(query, "session", "", state - 1);
  BrokenDigest broken{"session", session_id_, 0, 0, query.getColumn(state + 1), digest, {}, {}};
  broken.row = fmt::format("the header of session {}", session_id_);
  try {
    Cells cells(query, file_, "session");
    session_from(cells);
  } catch (const Error& error) {
    broken.damage = error.what();
  }
  if (broken.logged == digest && broken.damage.empty()) return std::nullopt;
  return broken;
}

std::optional<BrokenDigest> DigestCheck::broken_event() {
  SQLite::Statement query(database_, events_sql());
  query.bind(1, session_id_);
  std::string chain = start_;
  while (query.executeStep())
    if (auto broken = broken_link(query, "event", chain)) return broken;
  return std::nullopt;
}

std::optional<BrokenDigest> DigestCheck::broken_frame() {
  SQLite::Statement query(database_, frames_sql(database_));
  query.bind(1, session_id_);
  // By the attempt's cell. Pictures of a trial that is not there have a chain too, which no picture
  // fits.
  std::map<std::string, std::optional<std::string>> chains;  // none: broken already
  std::optional<BrokenDigest> first;
  while (query.executeStep()) {
    auto& chain = chains.try_emplace(query.getColumn(1).getString(), start_).first->second;
    if (!chain) continue;
    const auto broken = broken_link(query, "frame", *chain);
    if (!broken) continue;
    chain.reset();
    if (!first || is_earlier(*broken, *first)) first = broken;
  }
  return first;
}

std::string DigestCheck::recomputed(SQLite::Statement& query, const std::string& table,
                                    const std::string& previous, int last_cell) {
  digest_.begin(table, previous);
  for (int i = 1; i <= last_cell; ++i) digest_.cell(query.getColumn(i));
  return digest_.value();
}

std::optional<BrokenDigest> DigestCheck::broken_link(SQLite::Statement& query,
                                                     const std::string& table, std::string& chain) {
  const int last = query.getColumnCount() - 1;
  BrokenDigest broken{table, query.getColumn(0).getInt64(), 0, 0, query.getColumn(last), {}, {},
                      {}};
  broken.recomputed = recomputed(query, table, chain, last_digested(query, table));
  chain = broken.logged;
  if (broken.recomputed == broken.logged) return std::nullopt;
  set_place(broken, query);
  describe(broken, query, file_);
  return broken;
}

}  // namespace heft
