// Opening a log for reading: next to a running writer, after a crash, or on a read-only medium. The
// file may come from anyone, so nothing in it may be executed. Private to record.
#pragma once

#include <memory>
#include <string>

namespace SQLite {
class Database;
}

namespace heft {

/// How long a statement waits for another program's lock.
inline constexpr int lock_timeout_ms = 5000;

/// Disables triggers, views, functions in the schema, writes to the schema's tables and texts in
/// double quotes for this connection. Call it before the first statement.
/// @throws Error if this SQLite does not support it
void distrust(SQLite::Database& database);

/// @throws Error if the file is missing or cannot be read
std::unique_ptr<SQLite::Database> open_for_reading(const std::string& path);

}  // namespace heft
