// The log's tables and views. Columns come from the rows' descriptions (experiment/Rows.h); keys
// and references are defined here. Names of tables and columns are an interface to other programs.
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

/// "Heft" in ASCII: identifies a log for `file` and SQLite.
inline constexpr std::int64_t application_id = 0x48656674;

/// The version that this program writes; a file's version is its user_version.
inline constexpr int current_version = current_log_version;

/// Contents of a database file. An `older_log` is upgraded, an `outdated_log` refused.
enum class FileKind { empty, log, older_log, outdated_log, newer_log, foreign };
FileKind kind_of(SQLite::Database& database);

/// Creates tables and views in an empty file. Call it in a transaction.
void create(SQLite::Database& database);

/// Differences of the file's schema and closed lists from those that this program creates, one line
/// each.
std::vector<std::string> foreign_objects(SQLite::Database& database);

/// Objects that no log has: "trigger bad".
/// @param also objects that an older log may have
std::vector<std::string> unknown_objects(SQLite::Database& database,
                                         const std::set<std::string>& also);

/// Adds a task's words to the lists of words, unless present.
/// @throws Error (usage) for an unknown task
void add_words(SQLite::Database& database, std::string_view task);

/// The statement that creates an object of the current log. @param object "table answer"
const std::string& made_by(const std::string& object);

/// CREATE statements of all tables and indexes, and of the views.
std::string tables();
extern const std::string views;
/// Expression over a row f of `frame`: turn of the clone against the effector about its z axis.
inline constexpr const char* clone_yaw_deg_sql = R"sql(degrees(2 * atan(
    (f.effector_qw * f.clone_qz - f.effector_qz * f.clone_qw
     - f.effector_qx * f.clone_qy + f.effector_qy * f.clone_qx)
    / (f.effector_qw * f.clone_qw + f.effector_qz * f.clone_qz
       + f.effector_qx * f.clone_qx + f.effector_qy * f.clone_qy))))sql";

}  // namespace heft::schema
