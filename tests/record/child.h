// Runs a function in a child process, to kill it or to run it without root's rights.
#pragma once

#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <exception>
#include <stdexcept>
#include <string>
#include <utility>

namespace heft::test {

class Child {
 public:
  /// Runs work(fd) in a child; its output to fd can be read here.
  template <typename Work>
  explicit Child(const Work& work) {
    int ends[2];
    if (::pipe(ends) != 0) throw std::runtime_error("no pipe");
    process_ = ::fork();
    if (process_ < 0) throw std::runtime_error("no child process");
    if (process_ == 0) {
      ::close(ends[0]);
      work(ends[1]);
      ::_exit(0);
    }
    ::close(ends[1]);
    from_child_ = ends[0];
  }
  Child(const Child&) = delete;
  ~Child() {
    kill();
    ::close(from_child_);
  }

  pid_t process() const { return process_; }

  void kill() {
    if (std::exchange(ended_, true)) return;
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
  }

  /// One byte, or false at the end.
  bool read_byte() {
    char byte = 0;
    return ::read(from_child_, &byte, 1) == 1;
  }

  /// Reads until the child closes the pipe.
  std::string read_all() {
    std::string all;
    char bytes[4096];
    for (ssize_t n = 0; (n = ::read(from_child_, bytes, sizeof bytes)) > 0;)
      all.append(bytes, static_cast<std::size_t>(n));
    return all;
  }

 private:
  pid_t process_ = -1;
  int from_child_ = -1;
  bool ended_ = false;
};

inline void say(int descriptor, const std::string& text) {
  [[maybe_unused]] const ssize_t n = ::write(descriptor, text.data(), text.size());
}

/// The message of the exception that work() throws as a user without root's rights; "" if none.
template <typename Work>
std::string failure_as_ordinary_user(Work&& work) {
  constexpr uid_t nobody = 65534;
  Child child([&](int out) {
    if (::geteuid() == 0 && ::setresuid(nobody, nobody, nobody) != 0) return say(out, "no setuid");
    try {
      work();
    } catch (const std::exception& error) {
      say(out, error.what());
    }
  });
  return child.read_all();
}

}  // namespace heft::test
