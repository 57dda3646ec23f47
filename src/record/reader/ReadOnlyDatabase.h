// Opening a database file that may come from anybody, so that nothing that it holds may run; and
// opening a log for reading, wherever it lies: beside a running writer, after a crash, or on a
// medium that can't be written.
#pragma once

#include <memory>
#include <string>

namespace SQLite {
class Database;
}

namespace heft {

/// For how long a statement waits for another program's lock.
inline constexpr int lock_timeout_ms = 5000;

/// Triggers, views, functions named by the schema and writes to the schema's own tables are off for
/// this connection, and a word in double quotes is a name or a mistake. To be called before the
/// first statement; tables, their rules and references work as ever.
/// @throws Error when this SQLite can't
void distrust(SQLite::Database& database);

/// @throws Error when there is no such file, or it can't be read
std::unique_ptr<SQLite::Database> open_for_reading(const std::string& path);

}  // namespace heft
