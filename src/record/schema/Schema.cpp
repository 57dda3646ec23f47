#include "record/schema/Schema.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "record/schema/Binding.h"
#include "record/schema/RowSql.h"

namespace heft::schema {

namespace {
std::int64_t number(SQLite::Database& database, const char* query) {
  return database.execAndGet(query).getInt64();
}

void fill(SQLite::Database& database, const ClosedList& list) {
  SQLite::Statement insert(database, insert_sql(list.table, "name"));
  for (const std::string_view name : list.names) {
    insert.bind(1, std::string(name));
    insert.exec();
    insert.reset();
  }
}

// Objects, such as "table trial", and their CREATE statements.
std::map<std::string, std::string> objects_in(SQLite::Database& database) {
  std::map<std::string, std::string> objects;
  SQLite::Statement query(database,
                          "SELECT type || ' ' || name, ifnull(sql, '') FROM sqlite_master WHERE "
                          "name NOT LIKE 'sqlite\\_%' ESCAPE '\\'");
  while (query.executeStep())
    objects[query.getColumn(0).getString()] = query.getColumn(1).getString();
  return objects;
}

const std::map<std::string, std::string>& objects_of_a_log() {
  static const auto objects = [] {
    SQLite::Database fresh(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    create(fresh);
    return objects_in(fresh);
  }();
  return objects;
}

// Whether a list has only words of known tasks, and all words of the tasks with trials in the log.
// Words that an older edition of a task lacked may be missing.
bool is_ours(SQLite::Database& database, std::string_view list) {
  std::set<std::string> found;
  SQLite::Statement entries(database, fmt::format("SELECT name, task, edition FROM {}", list));
  while (entries.executeStep()) {
    const std::string word = entries.getColumn(0), name = entries.getColumn(1);
    const int edition = entries.getColumn(2);
    const TaskDeclaration* task = find_task(name);
    if (!task || edition < 1 || edition > task->edition) return false;
    const auto words = words_for(list, *task);
    if (std::ranges::find(words, std::string_view(word)) == words.end()) return false;
    found.insert(word);
  }
  SQLite::Statement tasks(database, "SELECT name, edition FROM list_task");
  while (tasks.executeStep()) {
    const std::string name = tasks.getColumn(0);
    const TaskDeclaration* task = find_task(name);
    if (!task) return false;
    if (tasks.getColumn(1).getInt() != task->edition) continue;
    for (const std::string_view word : words_for(list, *task))
      if (!found.contains(std::string(word))) return false;
  }
  return true;
}

std::vector<std::string> changed_lists(SQLite::Database& database) {
  std::vector<std::string> changed;
  for (const ClosedList& list : closed_lists()) {
    std::set<std::string> names, found;
    for (const std::string_view name : list.names) names.emplace(name);
    SQLite::Statement query(database, fmt::format("SELECT name FROM {}", list.table));
    while (query.executeStep()) found.insert(query.getColumn(0).getString());
    if (found != names) changed.push_back(fmt::format("the entries of {}", list.table));
  }
  for (const std::string_view list : word_lists)
    if (!is_ours(database, list)) changed.push_back(fmt::format("the entries of {}", list));
  return changed;
}
}  // namespace

FileKind kind_of(SQLite::Database& database) {
  const std::int64_t id = number(database, "PRAGMA application_id");
  const std::int64_t version = number(database, "PRAGMA user_version");
  if (id == application_id && version > current_version) return FileKind::newer_log;
  if (id == application_id && version == current_version) return FileKind::log;
  if (id == application_id && version >= oldest_log_version) return FileKind::older_log;
  if (id == application_id && version >= 1) return FileKind::outdated_log;
  const bool has_tables = number(database, "SELECT count(*) FROM sqlite_master") > 0;
  return id == 0 && version == 0 && !has_tables ? FileKind::empty : FileKind::foreign;
}

void create(SQLite::Database& database) {
  if (number(database, "PRAGMA user_version") == current_version) return;
  database.exec(fmt::format("PRAGMA application_id = {}", application_id));
  database.exec(tables());
  for (const ClosedList& list : closed_lists()) fill(database, list);
  database.exec(views);
  database.exec(fmt::format("PRAGMA user_version = {}", current_version));
}

std::vector<std::string> foreign_objects(SQLite::Database& database) {
  std::vector<std::string> foreign;
  const auto found = objects_in(database);
  for (const auto& [name, sql] : found) {
    const auto ours = objects_of_a_log().find(name);
    if (ours == objects_of_a_log().end())
      foreign.push_back(name);
    else if (ours->second != sql)
      foreign.push_back(name + ", which differs from that of heft");
  }
  for (const auto& [name, sql] : objects_of_a_log())
    if (!found.contains(name)) foreign.push_back(name + ", which is missing");
  if (foreign.empty()) foreign = changed_lists(database);
  return foreign;
}

std::vector<std::string> unknown_objects(SQLite::Database& database,
                                         const std::set<std::string>& also) {
  std::vector<std::string> unknown;
  for (const auto& [name, sql] : objects_in(database))
    if (!objects_of_a_log().contains(name) && !also.contains(name)) unknown.push_back(name);
  return unknown;
}

void add_words(SQLite::Database& database, std::string_view name) {
  const TaskDeclaration& task = task_named(name);
  for (const std::string_view list : word_lists) {
    SQLite::Statement insert(database, fmt::format("{} ON CONFLICT DO NOTHING",
                                                   insert_sql(list, "name, task, edition")));
    for (const std::string_view word : words_for(list, task))
      run(insert, std::string(word), std::string(task.name), task.edition);
  }
}

const std::string& made_by(const std::string& object) {
  return objects_of_a_log().at(object);
}

}  // namespace heft::schema
