// Ctrl-C, a polite kill and a closed terminal as a flag that long work looks at.
#pragma once

#include <array>
#include <atomic>

namespace heft::cli {

/// While one of these lives, SIGINT, SIGTERM and SIGHUP set the flag instead of ending the program.
/// A SIGHUP that was ignored (nohup) stays ignored.
class StopOnSignal {
 public:
  StopOnSignal();
  ~StopOnSignal();
  StopOnSignal(const StopOnSignal&) = delete;
  StopOnSignal& operator=(const StopOnSignal&) = delete;

  const std::atomic<bool>& requested() const;

 private:
  std::array<void (*)(int), 3> before_{};
};

}  // namespace heft::cli
