// Upgrades logs of versions 5 to 8. Digests are taken over values, not over names of columns, so
// they stay valid. Private to record.
#pragma once

namespace SQLite {
class Database;
}

namespace heft::schema {

/// Upgrades an older log to the current version, in one transaction. Digests do not change.
/// @throws Error (diverged) naming an unknown object; SQLite::Exception
void upgrade(SQLite::Database& database);

}  // namespace heft::schema
