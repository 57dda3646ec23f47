// What the studies time with: a clock that other processes don't disturb.
#pragma once

#include <time.h>

namespace heft {

/// Seconds that this thread has spent on a processor.
inline double thread_cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace heft
