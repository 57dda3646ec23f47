#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <set>
#include <utility>

#include "base/Error.h"
#include "record/file/LogFile.h"

namespace heft {

namespace {
using Inode = std::pair<dev_t, ino_t>;

Inode inode_of(const struct stat& file) {
  return {file.st_dev, file.st_ino};
}

// Files that this process has locked. They must not be opened again: closing that descriptor would
// drop SQLite's locks.
class Locked {
 public:
  bool holds(const std::string& file) {
    struct stat there {};
    const std::scoped_lock lock(mutex_);
    return ::stat(file.c_str(), &there) == 0 && inodes_.contains(inode_of(there));
  }
  void add(int descriptor) {
    struct stat mine {};
    const std::scoped_lock lock(mutex_);
    if (::fstat(descriptor, &mine) == 0) inodes_.insert(inode_of(mine));
  }
  void remove(int descriptor) {
    struct stat mine {};
    const std::scoped_lock lock(mutex_);
    if (::fstat(descriptor, &mine) == 0) inodes_.erase(inode_of(mine));
  }

 private:
  std::mutex mutex_;
  std::set<Inode> inodes_;
};

Locked& locked_here() {
  static Locked locked;
  return locked;
}

[[noreturn]] void refuse_second_writer(const std::string& path) {
  throw Error(
      fmt::format("{} is in use by another heft, perhaps under another name. Wait until it has "
                  "ended, or choose another file with --db FILE.",
                  path));
}

[[noreturn]] void refuse_unopened(const std::string& path, const std::string& file, int reason) {
  if (std::error_code unknown; reason == EACCES && std::filesystem::exists(file, unknown))
    throw Error(fmt::format(
        "cannot write to {}: the file is read-only ({}). Make it writable (chmod u+w), or choose "
        "another file with --db FILE.",
        path, std::strerror(reason)));
  throw Error(fmt::format(
      "cannot write to {}: {}. Choose a file in an existing writable folder (--db FILE).", path,
      std::strerror(reason)));
}

int opened_and_locked(const std::string& path, const std::string& file) {
  if (locked_here().holds(file)) refuse_second_writer(path);
  // Closed on exec, so that a child process does not keep the lock.
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NONBLOCK, 0600);
  if (descriptor < 0) refuse_unopened(path, file, errno);
  if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return descriptor;
  const int reason = errno;
  ::close(descriptor);
  if (reason == EWOULDBLOCK) refuse_second_writer(path);
  throw Error(fmt::format(
      "cannot lock {} ({}). Keep the log on a local disk (--db FILE) and copy it afterwards.", path,
      std::strerror(reason)));
}

// The current name of an open file; empty if unknown.
std::string name_now(int descriptor) {
  std::error_code unknown;
  return std::filesystem::read_symlink(fmt::format("/proc/self/fd/{}", descriptor), unknown)
      .string();
}
}  // namespace

FileLock::FileLock(const std::string& path, const std::string& file)
    : path_(path), file_(file), descriptor_(opened_and_locked(path, file)) {
  locked_here().add(descriptor_);
}

FileLock::FileLock(FileLock&& other) noexcept
    : path_(std::move(other.path_)),
      file_(std::move(other.file_)),
      descriptor_(std::exchange(other.descriptor_, -1)) {}

FileLock::~FileLock() {
  if (descriptor_ < 0) return;
  locked_here().remove(descriptor_);
  ::close(descriptor_);
}

bool FileLock::has_name() const {
  struct stat mine {};
  return ::fstat(descriptor_, &mine) != 0 || mine.st_nlink > 0;
}

std::string FileLock::displacement() const {
  struct stat mine {
  }, there{}, named{};
  if (::fstat(descriptor_, &mine) != 0)
    return fmt::format("cannot be examined any more ({})", std::strerror(errno));
  // A symbolic link in its place leads to the file, but the -wal file stays beside the link.
  const bool is_there = ::lstat(file_.c_str(), &there) == 0;
  const bool is_mine = is_there && inode_of(there) == inode_of(mine) &&
                       ::stat(path_.c_str(), &named) == 0 && inode_of(named) == inode_of(mine);
  if (mine.st_nlink == 0) return is_there ? "was replaced by another file" : "was deleted";
  if (!is_mine)
    return fmt::format("was {}moved to {}", is_there ? "replaced by another file, and " : "",
                       name_now(descriptor_));
  if (mine.st_nlink > 1)
    return "was given a second name (a hard link), under which SQLite does not find its newest "
           "rows";
  return "";
}

}  // namespace heft
