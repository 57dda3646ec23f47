// Upgrades logs of versions 5 to 8. Digests are taken over values, not over names of columns, so
// they stay valid.
#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <sqlite3.h>

#include "base/Error.h"
#include "record/file/LogFile.h"
#include "record/integrity/Seals.h"
#include "record/schema/RowSql.h"
#include "record/schema/Schema.h"

namespace heft::schema {

namespace {

// Rebuilding a table would drop a trigger or index on it unnoticed, so unknown objects are refused
// first.
void refuse_foreign(const std::vector<std::string>& foreign) {
  if (!foreign.empty())
    throw Error(fmt::format("the log was changed by another program: {}. Undo the change, or use "
                            "an older copy",
                            foreign.front()),
                ExitCode::diverged);
}

void drop_views(SQLite::Database& database) {
  for (const char* view : {"v_frame", "v_sorting", "v_trial", "v_jnd"})
    database.exec(fmt::format("DROP VIEW IF EXISTS {}", view));
}

// Copies a table's rows into a new table of today's declaration. @param values of a row, as SQL
void rebuild_table(SQLite::Database& database, const std::string& table,
                   const std::string& values = "*") {
  database.exec(fmt::format("CREATE TEMP TABLE older AS SELECT * FROM main.{}", table));
  database.exec(fmt::format("DROP TABLE main.{}", table));
  database.exec(made_by("table " + table));
  database.exec(fmt::format("INSERT INTO {} SELECT {} FROM older ORDER BY rowid", table, values));
  database.exec("DROP TABLE older");
}

// Version 6 added the last column, `value`.
void add_answer_values(SQLite::Database& database) {
  rebuild_table(database, "answer", "*, NULL");
  database.exec(made_by("index answer_by_trial"));
}

// Version 5 had the words of every task, version 6 those of the tasks that the log has trials of,
// in the order of their first trials.
void renew_words(SQLite::Database& database) {
  for (const std::string_view list : word_lists) {
    database.exec(fmt::format("DROP TABLE {}", list));
    database.exec(made_by(fmt::format("table {}", list)));
  }
  std::vector<std::string> tasks;
  SQLite::Statement query(database, "SELECT task FROM trial GROUP BY task ORDER BY min(trial_id)");
  while (query.executeStep()) tasks.push_back(query.getColumn(0).getString());
  for (const std::string& task : tasks) {
    if (!find_task(task))
      throw Error(fmt::format("the log has a trial of an unknown task: {}", task),
                  ExitCode::diverged);
    add_words(database, task);
  }
}

// Version 7 renamed columns, the list of reasons to stop and one of its words.
void rename_to_version_7(SQLite::Database& database) {
  for (const char* rename :
       {"cube RENAME deepest_push_m TO max_push_displacement_m",
        "event RENAME deepest_push_m TO max_push_displacement_m",
        "setup RENAME simulator_why TO simulator_reason", "setup RENAME handed TO controls"})
    database.exec(fmt::format("ALTER TABLE {}", rename));
  database.exec(made_by("table list_stop_reason"));
  database.exec("UPDATE estimate SET censored = 'indeterminate' WHERE censored = 'unsettled'");
  rebuild_table(database, "estimate");
  database.exec("DROP TABLE list_finish");
  database.exec("DELETE FROM list_censored WHERE name = 'unsettled'");
}

// Version 8 added the last column, `operator`.
void add_operator(SQLite::Database& database) {
  database.exec(made_by("table seal"));
  database.exec(made_by("index seal_by_session"));
  rebuild_table(database, "setup", "*, NULL");
}

// Version 9 added the last column, `table_friction`.
void add_table_friction(SQLite::Database& database) {
  rebuild_table(database, "cube", "*, NULL");
}

void extend_closed_lists(SQLite::Database& database) {
  for (const ClosedList& list : closed_lists())
    for (const std::string_view name : list.names)
      database.exec(fmt::format("INSERT OR IGNORE INTO {} VALUES ('{}')", list.table, name));
}

void rebuild(SQLite::Database& database) {
  refuse_foreign(unknown_objects(database, {"table list_finish"}));
  drop_views(database);
  const int version = database.execAndGet("PRAGMA user_version").getInt();
  if (version <= 5) {
    add_answer_values(database);
    renew_words(database);
  }
  if (version <= 6) rename_to_version_7(database);
  if (version <= 7) add_operator(database);
  add_table_friction(database);
  extend_closed_lists(database);
  seal_sessions(database);
  database.exec(views);
  database.exec(fmt::format("PRAGMA user_version = {}", current_version));
  refuse_foreign(foreign_objects(database));
}

}  // namespace

void upgrade(SQLite::Database& database) {
  database.exec("PRAGMA foreign_keys = OFF");
  SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
  try {
    if (kind_of(database) == FileKind::older_log) rebuild(database);
    transaction.commit();
  } catch (const SQLite::Exception& error) {
    if ((error.getErrorCode() & 0xff) != SQLITE_CONSTRAINT) throw;
    throw Error(fmt::format("the log has an invalid row: {}. Use a copy made before it was "
                            "changed",
                            error.what()),
                ExitCode::diverged);
  }
}

}  // namespace heft::schema
