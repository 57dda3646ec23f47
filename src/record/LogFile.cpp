#include "record/LogFile.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <sqlite3.h>

#include <filesystem>

#include "base/Error.h"
#include "record/Schema.h"
#include "record/SqliteError.h"

namespace heft {

namespace {
[[noreturn]] void refuse_newer_log(const std::string& path) {
  throw Error(fmt::format(
      "{} was written by a newer heft than this one ({}). Update heft, or choose another file with "
      "--db FILE.",
      path, HEFT_VERSION));
}

constexpr int busy_timeout_ms = 5000;

std::unique_ptr<SQLite::Database> opened(const std::string& path) {
  try {
    return std::make_unique<SQLite::Database>(
        resolved_path(path), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE, busy_timeout_ms);
  } catch (const SQLite::Exception& error) {
    const SqliteFailure failure = explained(error, nullptr);
    throw Error(
        fmt::format("can't open {} for writing: {}. {}.", path, failure.reason, failure.advice));
  }
}
}  // namespace

LogFile::LogFile(const std::string& path)
    : path_(path), lock_(path, resolved_path(path) + "-lock"), database_(opened(path)) {
  try {
    check_kind();
    prepare();
  } catch (const SQLite::Exception& error) {
    if (error.getErrorCode() == SQLITE_NOTADB) refuse_foreign_file(path_);
    const SqliteFailure failure = explained(error, database_.get());
    throw Error(fmt::format("can't write to {}: {}. {}.", path_, failure.reason, failure.advice));
  }
}

LogFile::LogFile(LogFile&&) noexcept = default;
LogFile::~LogFile() = default;

void LogFile::check_kind() {
  // SQLite opens a write-protected file for reading instead, and would refuse only the first row.
  if (sqlite3_db_readonly(database_->getHandle(), "main") == 1)
    throw Error(fmt::format(
        "can't write to {}: the file is read-only. Make it writable (chmod u+w), copy it to a "
        "folder of yours, or choose another file with --db FILE.",
        path_));
  holds_log(*database_, path_);
}

void LogFile::prepare() {
  const std::string mode = database_->execAndGet("PRAGMA journal_mode = WAL").getString();
  if (mode != "wal")
    throw Error(fmt::format(
        "can't write to {}: this disk does not support a write-ahead log (SQLite uses \"{}\" "
        "there). Keep the log on a local disk (--db FILE) and copy it afterwards.",
        path_, mode));
  database_->exec("PRAGMA synchronous = FULL");
  database_->exec("PRAGMA foreign_keys = ON");
}

std::string resolved_path(const std::string& path) {
  if (path.empty()) throw Error("the log's file name is empty. Give one with --db FILE.");
  std::error_code error;
  const auto resolved = std::filesystem::weakly_canonical(path, error);
  if (error) throw Error(fmt::format("can't open {}: {}", path, error.message()));
  if (std::filesystem::is_directory(resolved, error))
    throw Error(fmt::format("{} is a folder, expected a log file. Name a file in it: --db {}", path,
                            (std::filesystem::path(path) / "heft.db").string()));
  return std::filesystem::absolute(resolved).string();
}

void refuse_foreign_file(const std::string& path) {
  throw Error(
      fmt::format("{} is no heft log: it belongs to another program or is damaged, and was left as "
                  "it is. Choose "
                  "another file with --db FILE.",
                  path));
}

bool holds_log(SQLite::Database& database, const std::string& path) {
  switch (schema::kind_of(database)) {
    case schema::FileKind::foreign:
      refuse_foreign_file(path);
    case schema::FileKind::newer_log:
      refuse_newer_log(path);
    case schema::FileKind::empty:
      return false;
    case schema::FileKind::older_log:
    case schema::FileKind::log:
      return true;
  }
  return false;
}

}  // namespace heft
