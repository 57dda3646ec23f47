// Logs of version 5: their views, answers and lists of the tasks' words are made again, and the
// closed lists get the names added since. All other tables are as this program makes them.
#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <sqlite3.h>

#include "base/Error.h"
#include "record/schema/RowSql.h"
#include "record/schema/Schema.h"

namespace heft::schema {

namespace {

void extend_closed_lists(SQLite::Database& database) {
  for (const ClosedList& list : closed_lists())
    for (const std::string_view name : list.names)
      database.exec(fmt::format("INSERT OR IGNORE INTO {} VALUES ('{}')", list.table, name));
}

// Version 6 added the last column, `value`.
void renew_answers(SQLite::Database& database) {
  database.exec("CREATE TEMP TABLE older_answer AS SELECT * FROM main.answer");
  database.exec("DROP TABLE main.answer");
  database.exec(made_by("table answer"));
  database.exec(made_by("index answer_by_trial"));
  database.exec("INSERT INTO answer SELECT *, NULL FROM older_answer ORDER BY answer_id");
  database.exec("DROP TABLE older_answer");
}

// Version 5 had the words of every task, version 6 those of the tasks that the log has trials of,
// in the order of their first ones.
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
      throw Error(fmt::format("the log holds a trial of an unknown task: {}", task),
                  ExitCode::diverged);
    add_words(database, task);
  }
}

void renew_views(SQLite::Database& database) {
  for (const char* view : {"v_frame", "v_sorting", "v_trial", "v_jnd"})
    database.exec(fmt::format("DROP VIEW IF EXISTS {}", view));
  database.exec(views);
}

void rebuild(SQLite::Database& database) {
  extend_closed_lists(database);
  renew_answers(database);
  renew_words(database);
  renew_views(database);
  database.exec(fmt::format("PRAGMA user_version = {}", current_version));
  if (const auto foreign = foreign_objects(database); !foreign.empty())
    throw Error(fmt::format("the log differs from what heft makes: {}. Correct that, or continue "
                            "with a copy made before it was changed",
                            foreign.front()),
                ExitCode::diverged);
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
    throw Error(fmt::format("the log holds a row that heft never wrote: {}. Continue with a copy "
                            "made before it was changed",
                            error.what()),
                ExitCode::diverged);
  }
}

}  // namespace heft::schema
