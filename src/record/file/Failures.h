// Messages for failed reads and writes: SQLite's failures in plain words, what could not be saved,
// and what to do. Private to record.
#pragma once

#include <exception>
#include <string>

#include "base/Error.h"

namespace SQLite {
class Database;
class Exception;
}  // namespace SQLite

namespace heft {

/// Reason and remedy of a failure, for messages.
struct SqliteFailure {
  std::string reason;  ///< "the disk is full (SQLite: database or disk is full)"
  std::string advice;  ///< "Free some space"
};

/// @param database the failed connection, for the system's error; may be null
SqliteFailure explained(const SQLite::Exception& error, const SQLite::Database* database);

/// "WHAT: REASON. ADVICE."
Error sqlite_error(const std::string& what, const SQLite::Exception& error,
                   const SQLite::Database* database);

/// Whether another program's lock was the reason.
bool is_busy(const std::exception& error);

class LogFile;

/// Error for data that could not be saved: what, where, why, and what to do.
/// @param reason the caught SQLite::Exception, DisplacedLog, or Error for an invalid row
/// @param next what to do afterwards, for example "start again"
Error write_error(const std::string& what, const LogFile& file, const std::exception& reason,
                  const std::string& next);

}  // namespace heft
