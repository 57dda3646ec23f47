#include "record/file/Failures.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <sqlite3.h>

#include <cerrno>
#include <cstring>

#include "record/file/LogFile.h"

namespace heft {

namespace {
SqliteFailure input_output_failure(int extended_code, int system_error) {
  const bool no_space = system_error == ENOSPC || system_error == EDQUOT || system_error == EFBIG;
  if (no_space || (extended_code == SQLITE_IOERR_SHMSIZE && system_error == 0))
    return {system_error == EDQUOT  ? "the disk quota is used up"
            : system_error == EFBIG ? "the file has reached the largest size allowed"
                                    : "the disk is full",
            "Free some space"};
  return {"the disk could not be read or written", "Check the disk"};
}

// The system's error. SQLite returns it for some failures; the -wal file has the others.
int system_error_of(sqlite3* connection) {
  if (const int error = sqlite3_system_errno(connection); error != 0) return error;
  sqlite3_file* log = nullptr;
  sqlite3_file_control(connection, "main", SQLITE_FCNTL_JOURNAL_POINTER, &log);
  int error = 0;
  if (log != nullptr && log->pMethods != nullptr)
    log->pMethods->xFileControl(log, SQLITE_FCNTL_LAST_ERRNO, &error);
  return error;
}

SqliteFailure described_failure(int code, int extended_code, int system_error) {
  switch (code) {
    case SQLITE_FULL:
      return {"the disk is full", "Free some space"};
    case SQLITE_IOERR:
      return input_output_failure(extended_code, system_error);
    case SQLITE_READONLY:
    case SQLITE_PERM:
      return {"the file or its folder is read-only", "Make both writable"};
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return {"the file is locked by another program", "Close the other program"};
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB:
      return {"the file is damaged, or the disk that it is on fails",
              "Check the disk, keep a copy of the file together with those beside it that end in "
              "-wal and -shm, and continue with a backup"};
    case SQLITE_CANTOPEN:
      return {"the file or its -wal or -shm file cannot be opened",
              "Check that the folder exists and is writable"};
    case SQLITE_CONSTRAINT:
      return {"it violates a constraint of the log", "This is a bug in heft: please report it"};
    default:
      return {"the database failed", "Check the disk and the file"};
  }
}

}  // namespace

SqliteFailure explained(const SQLite::Exception& error, const SQLite::Database* database) {
  const int code = error.getErrorCode() & 0xff;
  const bool from_system = code == SQLITE_IOERR || code == SQLITE_CANTOPEN;
  const int system_error =
      from_system && database != nullptr ? system_error_of(database->getHandle()) : 0;
  SqliteFailure failure = described_failure(code, error.getExtendedErrorCode(), system_error);
  failure.reason += fmt::format(" (SQLite: {}", error.what());
  if (system_error != 0) failure.reason += fmt::format("; {}", std::strerror(system_error));
  failure.reason += ')';
  return failure;
}

Error sqlite_error(const std::string& what, const SQLite::Exception& error,
                   const SQLite::Database* database) {
  const SqliteFailure failure = explained(error, database);
  return Error(fmt::format("{}: {}. {}.", what, failure.reason, failure.advice));
}

bool is_busy(const std::exception& error) {
  const auto* reason = dynamic_cast<const SQLite::Exception*>(&error);
  const int code = reason ? reason->getErrorCode() & 0xff : SQLITE_OK;
  return code == SQLITE_BUSY || code == SQLITE_LOCKED;
}

Error write_error(const std::string& what, const LogFile& file, const std::exception& reason,
                  const std::string& next) {
  if (const auto* displaced = dynamic_cast<const DisplacedLog*>(&reason))
    return Error(fmt::format("could not save {} in {}: {}. {}, then {}", what, file.path(),
                             displaced->what(), displaced->remedy(), next));
  SqliteFailure failure{reason.what(), "This is a bug in heft: please report it"};
  if (const auto* error = dynamic_cast<const SQLite::Exception*>(&reason))
    failure = explained(*error, &file.database());
  return Error(fmt::format(
      "could not save {} in {}: {}. Everything acknowledged before is saved. {}, then {}", what,
      file.path(), failure.reason, failure.advice, next));
}

}  // namespace heft
