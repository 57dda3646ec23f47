#include "record/FileLock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "base/Error.h"

namespace heft {

FileLock::FileLock(const std::string& locked_file, const std::string& lock_path)
    // Closed on exec: a program started from here must not keep the lock alive.
    : descriptor_(::open(lock_path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
  if (descriptor_ < 0)
    throw Error(fmt::format(
        "can't write to {}: its lock file {} could not be made ({}). Choose a file in a folder "
        "that exists and that you may write to, on a disk that is not full and not write-protected "
        "(--db FILE).",
        locked_file, lock_path, std::strerror(errno)));
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
  const int reason = errno;
  ::close(descriptor_);
  if (reason == EWOULDBLOCK)
    throw Error(fmt::format(
        "{} is in use: another heft is writing to it (it holds the lock {}). Wait until it has "
        "ended, or choose another file with --db FILE.",
        locked_file, lock_path));
  throw Error(fmt::format(
      "can't lock {} ({}). Keep the log on a local disk (--db FILE) and copy it afterwards.",
      lock_path, std::strerror(reason)));
}

FileLock::FileLock(FileLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

FileLock::~FileLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace heft
