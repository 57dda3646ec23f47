// What a failed read or write tells the person in front of the screen: SQLite's failures in plain
// words, what could not be saved, and what to do. Private to this room.
#pragma once

#include <exception>
#include <optional>
#include <string>

#include "base/Error.h"
#include "experiment/Event.h"

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

class LogFile;

/// `the answer "label cube 2 heaviest" of trial 7`, `the event "cubes_reset" of trial 7`
std::string description(const Event& event, std::optional<int> trial_number);

/// What could not be saved, where, why, and what to do.
/// @param reason what was caught: SQLite's exception, DisplacedLog, or a row that can't be kept
/// @param next what to do once the cause is gone, e.g. "start again"
Error write_error(const std::string& what, const LogFile& file, const std::exception& reason,
                  const std::string& next);

}  // namespace heft
