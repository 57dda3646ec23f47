// The writer's lock, on the database file itself, so that it holds whatever name the file is opened
// by. It dies with the process that holds it, so a crash never leaves a stale one.
// A database file opened for writing: the lock is held, the file is a log or may become one, it
// lies where it is thought to be, and SQLite is set up so that a commit is on disk when it returns.
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

class FileLock {
 public:
  /// Makes the file where there is none, for its owner's eyes only. Closing a descriptor of the
  /// database drops the locks that SQLite holds on it in this process: make the lock before SQLite
  /// opens the file, and let it go after SQLite has closed it.
  /// @param path as the user wrote it  @param file the same with links and dots resolved
  /// @throws Error when another writer has the lock, or the file can't be opened or locked, or has
  ///   a second name
  FileLock(const std::string& path, const std::string& file);
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&&) = delete;
  ~FileLock();

  /// What has happened to the file since: "was moved to /lab/old.db". Empty while it still lies
  /// under its name, and under no other.
  std::string displacement() const;

  /// Whether the file still lies somewhere.
  bool has_name() const;

 private:
  std::string path_;  ///< as the user wrote it
  std::string file_;  ///< what that led to at the start, links resolved
  int descriptor_;
};

/// The file was moved, replaced, deleted or linked under the program that writes to it. What was
/// committed has been put together where what() says: in the file, or in a copy of it.
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
  /// @throws Error when another writer has the file, or it is no heft log, newer or much older than
  ///   this program, has a second name, or can't be written. An empty file has no tables yet
  ///   afterwards; an older log is brought up to date, with the older file kept beside it as
  ///   FILE.vN.
  explicit LogFile(const std::string& path);
  LogFile(LogFile&&) noexcept;
  ~LogFile();

  SQLite::Database& database() const { return *database_; }
  /// As the user wrote it.
  const std::string& path() const { return path_; }

  /// To be asked before and after each commit, so that nothing is called saved that nobody finds.
  /// @throws DisplacedLog
  void check_in_place();

 private:
  void refuse_if_displaced() const;
  void prepare();
  void bring_up_to_date();
  std::string displacement() const;
  bool is_gathered();
  std::string rescued() const;

  std::string path_;
  FileLock lock_;  ///< made before the connection and let go after it
  std::string file_;
  std::unique_ptr<SQLite::Database> database_;
  std::uint64_t wal_inode_ = 0;
  std::optional<DisplacedLog> displaced_;
};

/// The file with symbolic links and dots resolved, so that every name of a file is one file.
/// @throws Error for an empty name or a folder
std::string resolved_path(const std::string& path);

/// Whether the file holds a log that this program can use; false: nothing yet.
/// @throws Error for another program's file, or a log of a version that this program cannot read
bool holds_log(SQLite::Database& database, const std::string& path);

/// Refuses a file that is no log.
[[noreturn]] void refuse_foreign_file(const std::string& path);

}  // namespace heft
