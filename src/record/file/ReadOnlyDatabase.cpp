// Opening a log for reading: next to a running writer, after a crash, or on a read-only medium. The
// file may come from anyone, so nothing in it may be executed.
#include <SQLiteCpp/Backup.h>
#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <sqlite3.h>

#include <array>
#include <filesystem>
#include <utility>

#include "base/Error.h"
#include "record/file/Failures.h"
#include "record/file/LogFile.h"
#include "record/schema/Schema.h"

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
      throw Error("this version of SQLite cannot open untrusted files safely; use 3.31 or newer");
  }
}

namespace {
// Opening does not read the file, so read the schema.
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

// A read-only folder has no place for SQLite's -shm file. Without a -wal file there is no writer
// and the database is complete, so it can be opened as immutable.
std::unique_ptr<SQLite::Database> opened_in_read_only_folder(const std::string& path) {
  if (has_bytes(path + "-wal") || has_bytes(path + "-journal"))
    throw Error(
        fmt::format("cannot read {}: its last rows are in the file beside it (-wal or -journal), "
                    "and the folder "
                    "is read-only. Copy the files together to a writable folder.",
                    path));
  return opened(immutable_uri(path), SQLite::OPEN_READONLY | SQLite::OPEN_URI);
}

bool wants_to_write(const SQLite::Exception& error) {
  const int code = error.getErrorCode() & 0xff;
  return code == SQLITE_CANTOPEN || code == SQLITE_READONLY;
}

std::unique_ptr<SQLite::Database> opened_with_fallbacks(const std::string& path) {
  try {
    return opened(path, SQLite::OPEN_READONLY);
  } catch (const SQLite::Exception& error) {
    if (!wants_to_write(error)) throw;
  }
  try {
    // After a crash during its creation SQLite must roll the file back first.
    return opened(path, SQLite::OPEN_READWRITE);
  } catch (const SQLite::Exception& error) {
    if (!wants_to_write(error)) throw;
  }
  return opened_in_read_only_folder(path);
}

// Upgrades an older log in place or, if that is not possible (read-only, in use), in memory.
std::unique_ptr<SQLite::Database> upgraded_log(std::unique_ptr<SQLite::Database> older,
                                               const std::string& path, const std::string& file) {
  try {
    LogFile upgraded(path);
    return opened_with_fallbacks(file);
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
    throw Error(fmt::format("there is no file {}. Specify the log with --db FILE.", path));
  try {
    auto database = opened_with_fallbacks(file);
    if (schema::kind_of(*database) != schema::FileKind::older_log) return database;
    return upgraded_log(std::move(database), path, file);
  } catch (const SQLite::Exception& error) {
    if (error.getErrorCode() == SQLITE_NOTADB) refuse_foreign_file(path);
    throw sqlite_error(fmt::format("cannot read {}", path), error, nullptr);
  }
}

}  // namespace heft
