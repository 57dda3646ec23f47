// Logs of versions 1 to 3: their tables are made anew and their rows copied over as they are, so
// that one program text serves all versions from there on. Of versions 4 and 5 only the views, the
// answers and the lists of the tasks' words are made anew, and the closed lists get the names that
// they have since.
#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <sqlite3.h>

#include <array>
#include <string_view>
#include <utility>

#include "base/Error.h"
#include "record/Binding.h"
#include "record/Cells.h"
#include "record/OlderSetups.h"
#include "record/RowSql.h"
#include "record/RowVisitors.h"
#include "record/RowWriter.h"
#include "record/Schema.h"

namespace heft::schema {

namespace {

constexpr int without_setups = 2;      // version 1 differs in columns that may be NULL alone
constexpr int with_todays_frames = 4;  // and later

std::vector<std::string> tables_of(int version) {
  std::vector<std::string> tables{"session", "participant_info", "trial",    "event", "cube",
                                  "answer",  "reversal",         "estimate", "frame"};
  if (version <= without_setups) return tables;
  tables.emplace_back("setup");
  for (const ClosedList& list : closed_lists()) tables.emplace_back(list.table);
  for (const std::string_view list : word_lists) tables.emplace_back(list);
  return tables;
}
constexpr std::array older_others{"index event_by_session", "index answer_by_trial",
                                  "index frame_by_trial",   "view v_sorting",
                                  "view v_trial",           "view v_jnd"};

void refuse_foreign(SQLite::Database& database, const std::vector<std::string>& older_tables) {
  SQLite::Statement query(database,
                          "SELECT type, name FROM sqlite_master WHERE name NOT LIKE 'sqlite\\_%' "
                          "ESCAPE '\\'");
  while (query.executeStep()) {
    const std::string type = query.getColumn(0), name = query.getColumn(1);
    const bool ours =
        type == "table" ? std::ranges::find(older_tables, name) != older_tables.end()
                        : std::ranges::find(older_others, type + " " + name) != older_others.end();
    if (!ours)
      throw Error(
          fmt::format("the log holds a {} that is none of heft's: {}. Take it out, or go on "
                      "with a copy that never had it",
                      type, name),
          ExitCode::diverged);
  }
}

std::string older(std::string_view table) {
  return fmt::format("older_{}", table);
}

void set_aside(SQLite::Database& database, const std::vector<std::string>& older_tables) {
  for (const std::string_view other : older_others) database.exec(fmt::format("DROP {}", other));
  for (const std::string& table : older_tables)
    database.exec(fmt::format("ALTER TABLE {} RENAME TO {}", table, older(table)));
}

// The columns that the older table has, as both have them.
std::string shared_columns(SQLite::Database& database, const std::string& table) {
  std::string columns;
  SQLite::Statement query(database, fmt::format("SELECT o.name FROM pragma_table_info('{}') o JOIN "
                                                "pragma_table_info('{}') n ON n.name = o.name",
                                                older(table), table));
  while (query.executeStep())
    columns += (columns.empty() ? "" : ", ") + query.getColumn(0).getString();
  return columns;
}

void copy(SQLite::Database& database, const std::string& table, std::string_view more = "",
          std::string_view values = "") {
  const std::string columns = shared_columns(database, table);
  database.exec(fmt::format("INSERT INTO {0} ({1}{2}) SELECT {1}{3} FROM {4} o ORDER BY rowid",
                            table, columns, more, values, older(table)));
}

std::vector<std::pair<std::int64_t, SessionHeader>> sessions_in(SQLite::Database& database,
                                                                const std::string& path) {
  std::vector<std::pair<std::int64_t, SessionHeader>> sessions;
  SQLite::Statement query(
      database, fmt::format("SELECT session_id, {} FROM session", columns_of<SessionHeader>()));
  while (query.executeStep()) {
    Cells cells(query, path, "session");
    sessions.emplace_back(cells.id(), row_from<SessionHeader>(cells));
  }
  return sessions;
}

// A session's setups, and each trial's: that in force when it started.
void tell_setups(SQLite::Database& database, std::int64_t session_id, const SessionHeader& header) {
  RowWriter writer(database);
  OlderSetups older(header);
  std::int64_t setup_id = writer.write_setup(session_id, std::nullopt, older.first().value());
  SQLite::Statement point(database, "UPDATE trial SET setup_id = ? WHERE trial_id = ?");
  SQLite::Statement events(
      database,
      "SELECT event_id, CASE kind WHEN 'trial_started' THEN trial_id END, detail FROM event WHERE "
      "session_id = ? AND kind IN ('trial_started', 'deviation') ORDER BY event_id");
  events.bind(1, session_id);
  while (events.executeStep()) {
    if (const auto trial = events.getColumn(1); !trial.isNull())
      run(point, setup_id, trial.getInt64());
    const Event told = older.told({0, Deviation{events.getColumn(2)}});
    if (const auto* setup = told.as<SessionConfig>())
      setup_id = writer.write_setup(session_id, events.getColumn(0).getInt64(), *setup);
  }
}

void copy_rows_without_setups(SQLite::Database& database) {
  copy(database, "session", ", log_version, n_events, n_frames",
       fmt::format(", {}, (SELECT count(*) FROM older_event e WHERE e.session_id = o.session_id), "
                   "(SELECT count(*) FROM older_frame f WHERE f.session_id = o.session_id)",
                   without_setups));
  copy(database, "cube", ", n_resets",
       ", (SELECT count(*) FROM older_event e WHERE e.trial_id = o.trial_id AND e.kind = "
       "'cubes_reset' AND (e.slot IS NULL OR e.slot = o.slot))");
}

// Words are those of the tasks that the log has trials of, in the order of their first ones.
void tell_words(SQLite::Database& database) {
  std::vector<std::string> tasks;
  SQLite::Statement query(database, "SELECT task FROM trial GROUP BY task ORDER BY min(trial_id)");
  while (query.executeStep()) tasks.push_back(query.getColumn(0).getString());
  for (const std::string& task : tasks) {
    if (place_of(task) == words_of<Task>().size())
      throw Error(fmt::format("the log holds a trial of no task of heft's: {}", task),
                  ExitCode::diverged);
    add_words(database, task);
  }
}

void renew_answers_and_words(SQLite::Database& database) {
  std::vector<std::string> tables{"answer"};
  tables.insert(tables.end(), word_lists.begin(), word_lists.end());
  database.exec("DROP INDEX answer_by_trial");
  for (const std::string& table : tables) {
    database.exec(fmt::format("ALTER TABLE {} RENAME TO {}", table, older(table)));
    database.exec(made_by("table " + table));
  }
  copy(database, "answer");
  database.exec(made_by("index answer_by_trial"));
  for (const std::string& table : tables) database.exec(fmt::format("DROP TABLE {}", older(table)));
  tell_words(database);
}

void renew(SQLite::Database& database) {
  for (const ClosedList& list : closed_lists())
    for (const std::string_view name : list.names)
      database.exec(fmt::format("INSERT OR IGNORE INTO {} VALUES ('{}')", list.table, name));
  for (const char* view : {"v_frame", "v_sorting", "v_trial", "v_jnd"})
    database.exec(fmt::format("DROP VIEW IF EXISTS {}", view));
  renew_answers_and_words(database);
  database.exec(views);
  database.exec(fmt::format("PRAGMA user_version = {}", current_version));
  if (const auto foreign = foreign_objects(database); !foreign.empty())
    throw Error(fmt::format("the log holds what is none of heft's, or lacks what is: {}. Put that "
                            "right, or go on with a copy from before",
                            foreign.front()),
                ExitCode::diverged);
}

void rebuild(SQLite::Database& database, const std::string& path) {
  const int version = database.execAndGet("PRAGMA user_version").getInt();
  if (version >= with_todays_frames) return renew(database);
  const std::vector<std::string> older_tables = tables_of(version);
  refuse_foreign(database, older_tables);
  set_aside(database, older_tables);
  database.exec("PRAGMA user_version = 0");
  create(database);
  if (version <= without_setups) {
    copy_rows_without_setups(database);
  } else {
    for (const char* table : {"session", "cube"}) copy(database, table);
    copy(database, "setup", ", keys", ", ''");  // not told
  }
  copy(database, "trial", ", is_practice", ", 0");  // there was none
  for (const char* table : {"participant_info", "event", "answer", "reversal", "estimate", "frame"})
    copy(database, table);
  tell_words(database);
  if (version <= without_setups)
    for (const auto& [id, header] : sessions_in(database, path)) tell_setups(database, id, header);
  for (const std::string& table : older_tables)
    database.exec(fmt::format("DROP TABLE {}", older(table)));
}

}  // namespace

void upgrade(SQLite::Database& database) {
  const std::string path = database.getFilename();
  database.exec("PRAGMA foreign_keys = OFF");
  database.exec(
      "PRAGMA legacy_alter_table = ON");  // nothing is to follow a table that is set aside
  SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
  try {
    if (kind_of(database) == FileKind::older_log) rebuild(database, path);
    transaction.commit();
  } catch (const SQLite::Exception& error) {
    if ((error.getErrorCode() & 0xff) != SQLITE_CONSTRAINT) throw;
    throw Error(fmt::format("the log holds a row that heft never wrote: {}. Go on with a copy from "
                            "before it was changed",
                            error.what()),
                ExitCode::diverged);
  }
  database.exec("PRAGMA legacy_alter_table = OFF");
}

}  // namespace heft::schema
