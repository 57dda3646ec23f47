// The writer's lock: an OS lock on a file beside the database. It dies with the process that holds
// it, so a crash never leaves a stale one; the empty file stays.
#pragma once

#include <string>

namespace heft {

class FileLock {
 public:
  /// @param locked_file the file that is guarded, for messages  @param lock_path the file beside it
  /// @throws Error when another process has the lock, or the lock file can't be made
  FileLock(const std::string& locked_file, const std::string& lock_path);
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&&) = delete;
  ~FileLock();

 private:
  int descriptor_;
};

}  // namespace heft
