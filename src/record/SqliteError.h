// SQLite's failures in plain words.
#pragma once

#include <exception>
#include <string>

namespace SQLite {
class Database;
class Exception;
}  // namespace SQLite

namespace heft {

/// Why it failed and what to do about it, each for a person to read.
struct SqliteFailure {
  std::string reason;  ///< "the disk is full (SQLite: database or disk is full)"
  std::string advice;  ///< "Free some space"
};

/// @param database the connection that failed, for the system's own reason; may be null
SqliteFailure explained(const SQLite::Exception& error, const SQLite::Database* database);

/// Whether another program's lock was in the way: the same will go well once it is gone.
bool is_busy(const std::exception& error);

}  // namespace heft
