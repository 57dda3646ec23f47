// A database file may come from anybody: nothing that it holds may run.
#pragma once

namespace SQLite {
class Database;
}

namespace heft {

/// Triggers, views, functions named by the schema and writes to the schema's own tables are off for
/// this connection, and a word in double quotes is a name or a mistake. To be called before the
/// first statement; tables, their rules and references work as ever.
/// @throws Error when this SQLite can't
void distrust(SQLite::Database& database);

}  // namespace heft
