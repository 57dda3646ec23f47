// Private to record.
#pragma once

namespace SQLite {
class Database;
}

namespace heft {

/// Renumbers all rows of a copy of a log, for pseudonymised exports: persons are in random order,
/// each person's sessions in their own. Ids and the order of rows then tell nothing about who took
/// part when. Digests and seals become invalid.
void draw_fresh_ids(SQLite::Database& database);

}  // namespace heft
