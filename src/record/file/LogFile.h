// A log's database file: opened for writing, with the writer's lock, or for reading. Private to
// record.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

namespace SQLite {
class Database;
}

namespace heft {

/// The writer's lock on the database file itself, under whatever name it is opened. The kernel
/// releases it when the process ends.
class FileLock {
 public:
  /// Creates the file, readable by its owner only, if it is missing. Closing any descriptor of the
  /// file drops SQLite's locks on it in this process: create the lock before SQLite opens the file,
  /// and destroy it after SQLite has closed it.
  /// @param path as given by the user  @param file the same with links and dots resolved
  /// @throws Error if another writer has the lock, the file cannot be opened or locked, or it has a
  ///   second name
  FileLock(const std::string& path, const std::string& file);
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&&) = delete;
  ~FileLock();

  /// What happened to the file: "was moved to /lab/old.db". Empty if it still has its name and no
  /// other.
  std::string displacement() const;

  /// Whether the file still has a name.
  bool has_name() const;

 private:
  std::string path_;  ///< as given by the user
  std::string file_;  ///< initially, links resolved
  int descriptor_;
};

/// The file was moved, replaced, deleted or linked during writing. what() names the file, or the
/// copy of it, that has all committed data.
class DisplacedLog : public std::runtime_error {
 public:
  DisplacedLog(const std::string& happened, std::string remedy)
      : std::runtime_error(happened), remedy_(std::move(remedy)) {}
  const std::string& remedy() const { return remedy_; }  ///< "Move it back"

 private:
  std::string remedy_;
};

class LogFile {
 public:
  /// An empty file remains without tables. An older log is upgraded, and the older file is kept as
  /// FILE.vN.
  /// @throws Error if another writer has the file, it is no heft log or of an unsupported version,
  ///   has a second name or cannot be written
  explicit LogFile(const std::string& path);
  LogFile(LogFile&&) noexcept;
  ~LogFile();

  SQLite::Database& database() const { return *database_; }
  /// As given by the user.
  const std::string& path() const { return path_; }

  /// Call it before and after each commit.
  /// @throws DisplacedLog
  void check_in_place();

 private:
  void refuse_if_displaced() const;
  void prepare();
  void upgrade();
  std::string displacement() const;
  bool checkpoint();
  std::string rescue() const;

  std::string path_;
  FileLock lock_;  ///< outlives the connection
  std::string file_;
  std::unique_ptr<SQLite::Database> database_;
  std::uint64_t wal_inode_ = 0;
  std::optional<DisplacedLog> displaced_;
};

/// The path with symbolic links and dots resolved.
/// @throws Error for an empty name or a folder
std::string resolved_path(const std::string& path);

/// Whether the file is a log; false: it is empty.
/// @throws Error for another program's file or an unsupported version
bool holds_log(SQLite::Database& database, const std::string& path);

/// @throws Error: the file is no log
[[noreturn]] void refuse_foreign_file(const std::string& path);

/// How long a statement waits for another program's lock.
inline constexpr int lock_timeout_ms = 5000;

/// Disables triggers, views, functions in the schema, writes to the schema's tables and texts in
/// double quotes for this connection. Call it before the first statement.
/// @throws Error if this SQLite does not support it
void distrust(SQLite::Database& database);

/// @throws Error if the file is missing or cannot be read
std::unique_ptr<SQLite::Database> open_for_reading(const std::string& path);

}  // namespace heft

namespace heft::schema {

/// Upgrades an older log to the current version, in one transaction. Digests do not change.
/// @throws Error (diverged) naming an unknown object; SQLite::Exception
void upgrade(SQLite::Database& database);

}  // namespace heft::schema
