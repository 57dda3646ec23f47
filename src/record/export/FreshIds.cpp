// Fresh ids for pseudonymised exports.
#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "record/export/ExportSource.h"

namespace heft {

namespace {
// A table, SQL for the session of its row r, and the columns of other tables with its rowid.
struct Numbered {
  std::string name, session;
  std::vector<std::pair<std::string, std::string>> references;
};

std::vector<Numbered> numbered_tables() {
  const std::string own = "r.session_id",
                    of_trial = "(SELECT session_id FROM trial WHERE trial_id = r.trial_id)";
  // Tables found by their trial come before it.
  return {{"cube", of_trial, {}},
          {"answer", of_trial, {}},
          {"reversal", own, {}},
          {"estimate", own, {}},
          {"frame", own, {}},
          {"event", own, {{"setup", "from_event_id"}}},
          {"setup", own, {{"trial", "setup_id"}, {"participant_parameter", "setup_id"}}},
          {"trial",
           own,
           {{"event", "trial_id"},
            {"frame", "trial_id"},
            {"cube", "trial_id"},
            {"answer", "trial_id"},
            {"reversal", "trial_id"}}},
          {"session",
           own,
           {{"event", "session_id"},
            {"frame", "session_id"},
            {"setup", "session_id"},
            {"trial", "session_id"},
            {"reversal", "session_id"},
            {"estimate", "session_id"},
            {"participant_info", "session_id"},
            {"participant_parameter", "session_id"}}}};
}

// Twice, because a new id may be another row's old one.
void renumber(SQLite::Database& database, const std::string& table, const std::string& column) {
  database.exec(fmt::format(
      "UPDATE {0} SET {1} = -(SELECT fresh FROM fresh_id WHERE old = {0}.{1}) WHERE {1} NOTNULL;"
      "UPDATE {0} SET {1} = -{1} WHERE {1} < 0",
      table, column));
}
}  // namespace

void draw_fresh_ids(SQLite::Database& database) {
  database.exec(
      "PRAGMA foreign_keys = OFF;"
      "DELETE FROM seal;"
      "DELETE FROM session WHERE state = 'withdrawn';"
      "CREATE TEMP TABLE person AS SELECT participant, random() AS place FROM session GROUP BY 1;"
      "CREATE TEMP TABLE place AS SELECT session_id, row_number() OVER (ORDER BY p.place, "
      "session_id) AS place FROM session JOIN person p USING (participant)");
  for (const Numbered& table : numbered_tables()) {
    database.exec(fmt::format(
        "CREATE TEMP TABLE fresh_id (old INTEGER PRIMARY KEY, fresh INTEGER);"
        "INSERT INTO fresh_id SELECT r.rowid, row_number() OVER (ORDER BY p.place, r.rowid) FROM "
        "{} r JOIN place p ON p.session_id = {}",
        table.name, table.session));
    renumber(database, table.name, "rowid");
    for (const auto& [other, column] : table.references) renumber(database, other, column);
    database.exec("DROP TABLE fresh_id");
  }
}

}  // namespace heft
