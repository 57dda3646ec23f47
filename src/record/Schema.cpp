#include "record/Schema.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "record/Tables.h"

namespace heft::schema {

namespace {
void create_version_1(SQLite::Database& database) {
  database.exec(fmt::format("PRAGMA application_id = {}", application_id));
  database.exec(tables_1);
  database.exec(views_1);
}

void add_frame_timing(SQLite::Database& database) {
  database.exec(changes_2);
}

// migrations[n] takes a file from user_version n to n + 1.
constexpr std::array migrations{create_version_1, add_frame_timing};

std::int64_t number(SQLite::Database& database, const char* query) {
  return database.execAndGet(query).getInt64();
}

std::vector<std::string_view> columns_in(std::string_view list) {
  std::vector<std::string_view> columns;
  for (;;) {
    const auto comma = list.find(',');
    columns.push_back(list.substr(0, comma));
    if (comma == std::string_view::npos) return columns;
    list.remove_prefix(comma + 2);
  }
}
}  // namespace

int current_version() {
  return static_cast<int>(migrations.size());
}

FileKind kind_of(SQLite::Database& database) {
  const std::int64_t id = number(database, "PRAGMA application_id");
  const std::int64_t version = number(database, "PRAGMA user_version");
  if (id == application_id && version > current_version()) return FileKind::newer_log;
  if (id == application_id && version >= 1) return FileKind::log;
  const bool has_tables = number(database, "SELECT count(*) FROM sqlite_master") > 0;
  return id == 0 && version == 0 && !has_tables ? FileKind::empty : FileKind::foreign;
}

void migrate(SQLite::Database& database) {
  const auto version = static_cast<std::size_t>(number(database, "PRAGMA user_version"));
  if (version == migrations.size()) return;
  for (std::size_t from = version; from < migrations.size(); ++from) migrations[from](database);
  database.exec(fmt::format("PRAGMA user_version = {}", current_version()));
}

std::string frame_timing_in(SQLite::Database& database) {
  if (number(database, "PRAGMA user_version") >= 2) return std::string(frame_timing_columns);
  return "NULL AS detected_s, NULL AS simulated_s, NULL AS n_dropped";
}

std::string insert_sql(std::string_view table, std::string_view columns) {
  std::string places = "?";
  for (auto n = std::count(columns.begin(), columns.end(), ','); n > 0; --n) places += ", ?";
  return fmt::format("INSERT INTO {} ({}) VALUES ({})", table, columns, places);
}

std::string upsert_sql(std::string_view table, std::string_view columns, std::string_view key) {
  const auto keys = columns_in(key);
  std::string changes;
  for (std::string_view column : columns_in(columns))
    // Assigning a key even its own value makes SQLite search for rows that refer to the old one.
    if (std::find(keys.begin(), keys.end(), column) == keys.end())
      changes += fmt::format("{}{} = excluded.{}", changes.empty() ? "" : ", ", column, column);
  return fmt::format("{} ON CONFLICT ({}) DO UPDATE SET {}", insert_sql(table, columns), key,
                     changes);
}

}  // namespace heft::schema
