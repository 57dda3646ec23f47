// A database file opened for writing: the lock is held, the file is a log or may become one, and
// SQLite is set up so that a commit is on disk when it returns.
#pragma once

#include <memory>
#include <string>

#include "record/FileLock.h"

namespace SQLite {
class Database;
}

namespace heft {

class LogFile {
 public:
  /// @throws Error when another writer has the file, or it is no heft log, newer than this program,
  ///   or can't be written. An empty file has no tables yet afterwards.
  explicit LogFile(const std::string& path);
  LogFile(LogFile&&) noexcept;
  ~LogFile();

  SQLite::Database& database() const { return *database_; }
  /// As the user wrote it.
  const std::string& path() const { return path_; }

 private:
  void check_kind();
  void prepare();

  std::string path_;
  FileLock lock_;
  std::unique_ptr<SQLite::Database> database_;
};

/// The file with symbolic links and dots resolved, so that every name of a file is one file.
/// @throws Error for an empty name or a folder
std::string resolved_path(const std::string& path);

/// Whether the file holds a log that this program can use; false: nothing yet.
/// @throws Error for another program's file, or a log newer than this program
bool holds_log(SQLite::Database& database, const std::string& path);

/// Refuses a file that is no log.
[[noreturn]] void refuse_foreign_file(const std::string& path);

}  // namespace heft
