#include "record/reader/ReadOnlyDatabase.h"

#include <SQLiteCpp/Backup.h>
#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <sqlite3.h>

#include <array>
#include <filesystem>
#include <utility>

#include "base/Error.h"
#include "record/schema/Schema.h"
#include "record/writer/Failures.h"
#include "record/writer/LogFile.h"

namespace heft {

void distrust(SQLite::Database& database) {
  constexpr std::array<std::pair<int, int>, 6> settings{{{SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0},
                                                         {SQLITE_DBCONFIG_DEFENSIVE, 1},
                                                         {SQLITE_DBCONFIG_ENABLE_TRIGGER, 0},
                                                         {SQLITE_DBCONFIG_ENABLE_VIEW, 0},
                                                         {SQLITE_DBCONFIG_DQS_DDL, 0},
                                                         {SQLITE_DBCONFIG_DQS_DML, 0}}};
  for (const auto& [setting, wanted] : settings) {
    int now = -1;
    if (sqlite3_db_config(database.getHandle(), setting, wanted, &now) != SQLITE_OK ||
        now != wanted)
      throw Error("this SQLite can't open files from elsewhere safely; heft needs 3.31 or newer");
  }
}

namespace {
// Opening does not read yet, so a first look is part of it.
std::unique_ptr<SQLite::Database> opened(const std::string& name, int flags) {
  auto database = std::make_unique<SQLite::Database>(name, flags, lock_timeout_ms);
  distrust(*database);
  database->exec("PRAGMA query_only = ON");
  database->execAndGet("SELECT count(*) FROM sqlite_master");
  return database;
}

bool has_bytes(const std::string& path) {
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  return !error && size > 0;
}

std::string immutable_uri(const std::string& path) {
  std::string uri = "file:";
  for (const char c : path) {
    if (c == '%' || c == '?' || c == '#')
      uri += fmt::format("%{:02x}", static_cast<unsigned char>(c));
    else
      uri += c;
  }
  return uri + "?immutable=1";
}

// A folder that can't be written has no place for SQLite's -shm file. Without a -wal file nobody is
// writing and everything is in the database itself, which may then be read as it lies there.
std::unique_ptr<SQLite::Database> opened_where_nothing_can_be_written(const std::string& path) {
  if (has_bytes(path + "-wal") || has_bytes(path + "-journal"))
    throw Error(fmt::format(
        "can't read {}: its last rows are still in the file beside it (-wal or -journal), and the "
        "folder is read-only. Copy the files together to a folder that you may write to.",
        path));
  return opened(immutable_uri(path), SQLite::OPEN_READONLY | SQLite::OPEN_URI);
}

bool wants_to_write(const SQLite::Exception& error) {
  const int code = error.getErrorCode() & 0xff;
  return code == SQLITE_CANTOPEN || code == SQLITE_READONLY;
}

std::unique_ptr<SQLite::Database> opened_somehow(const std::string& path) {
  try {
    return opened(path, SQLite::OPEN_READONLY);
  } catch (const SQLite::Exception& error) {
    if (!wants_to_write(error)) throw;
  }
  try {
    // After a crash while the file was created SQLite must undo something first.
    return opened(path, SQLite::OPEN_READWRITE);
  } catch (const SQLite::Exception& error) {
    if (!wants_to_write(error)) throw;
  }
  return opened_where_nothing_can_be_written(path);
}

// An older log is brought up to date where it lies, or, where that can't be (a medium or folder
// that can't be written, a writer of the older program), in memory for whoever looks.
std::unique_ptr<SQLite::Database> brought_up_to_date(std::unique_ptr<SQLite::Database> older,
                                                     const std::string& path,
                                                     const std::string& file) {
  try {
    LogFile upgraded(path);
    return opened_somehow(file);
  } catch (const Error& error) {
    if (error.exit_code() == ExitCode::diverged) throw;
  }
  auto copy =
      std::make_unique<SQLite::Database>(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
  distrust(*copy);
  SQLite::Backup(*copy, *older).executeStep();
  schema::upgrade(*copy);
  return copy;
}
}  // namespace

std::unique_ptr<SQLite::Database> open_for_reading(const std::string& path) {
  const std::string file = resolved_path(path);
  if (!std::filesystem::exists(file))
    throw Error(fmt::format("there is no file {}. Name the log with --db FILE.", path));
  try {
    auto database = opened_somehow(file);
    if (schema::kind_of(*database) != schema::FileKind::older_log) return database;
    return brought_up_to_date(std::move(database), path, file);
  } catch (const SQLite::Exception& error) {
    if (error.getErrorCode() == SQLITE_NOTADB) refuse_foreign_file(path);
    const SqliteFailure failure = explained(error, nullptr);
    throw Error(fmt::format("can't read {}: {}. {}.", path, failure.reason, failure.advice));
  }
}

}  // namespace heft
