// The writer's lock, on the database file itself, so that it holds whatever name the file is opened
// by. It dies with the process that holds it, so a crash never leaves a stale one.
#pragma once

#include <string>

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

}  // namespace heft
