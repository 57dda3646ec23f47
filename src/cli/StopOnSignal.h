// Ctrl-C and a polite kill as a flag that long work looks at.
#pragma once

#include <atomic>

namespace heft::cli {

/// While one of these lives, SIGINT and SIGTERM set the flag instead of ending the program.
class StopOnSignal {
 public:
  StopOnSignal();
  ~StopOnSignal();
  StopOnSignal(const StopOnSignal&) = delete;
  StopOnSignal& operator=(const StopOnSignal&) = delete;

  const std::atomic<bool>& requested() const;

 private:
  void (*interrupt_)(int);
  void (*terminate_)(int);
};

}  // namespace heft::cli
