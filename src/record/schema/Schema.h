// The log's tables and views. Their columns come from the rows' descriptions (experiment/Rows.h);
// what is said here is how tables hang together. DESIGN.md, "The log", is the contract for names.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "experiment/Column.h"

namespace SQLite {
class Database;
}

namespace heft::schema {

/// "Heft" in ASCII: marks the file as ours for `file` and for SQLite.
inline constexpr std::int64_t application_id = 0x48656674;

/// The version that this program writes; the file's is its user_version.
inline constexpr int current_version = todays_log_version;

/// What a database file holds. An `older_log` is upgraded, an `outdated_log` is no longer read.
enum class FileKind { empty, log, older_log, outdated_log, newer_log, foreign };
FileKind kind_of(SQLite::Database& database);

/// Creates tables and views in an empty file; nothing where they are there. Call it in a
/// transaction.
void create(SQLite::Database& database);

/// What the file's schema has that a log of its version has not, lacks, or has otherwise, and
/// entries of closed lists likewise; one line each. Empty: it is as this program made it.
std::vector<std::string> foreign_objects(SQLite::Database& database);

/// Names of objects that no log has: "trigger bad".
/// @param also names that an older log may have
std::vector<std::string> unknown_objects(SQLite::Database& database,
                                         const std::set<std::string>& also);

/// Adds what a task brings to the lists of words, unless it is there.
/// @throws Error (usage) for a task that is none of ours
void add_words(SQLite::Database& database, std::string_view task);

/// The statement that makes a table or index of today's log: "table answer".
const std::string& made_by(const std::string& object);

/// Upgrades an older log to the current version, in one transaction; digests stay as they were.
/// @throws Error (diverged) naming what is foreign in it; SQLite::Exception
void upgrade(SQLite::Database& database);

/// CREATE statements of all tables and indexes, from the rows' descriptions; of the views.
std::string tables();
extern const char* const views;

}  // namespace heft::schema
