// Session time: seconds since the session started. A virtual clock follows the frames' times, so
// that no result depends on the time of day. A wall clock is the machine's monotonic clock, for
// participants and cameras.
#pragma once

#include <algorithm>

#include "base/Clock.h"

namespace heft {

class SessionClock {
 public:
  static SessionClock virtual_from(double start_s) { return {false, start_s}; }
  /// @param monotonic replaced in tests
  static SessionClock wall_from(double start_s, double (*monotonic)() = monotonic_s) {
    return {true, start_s, monotonic};
  }

  bool is_wall() const { return is_wall_; }

  double now_s() const { return is_wall_ ? session_s(monotonic_()) : now_s_; }

  /// Converts a time of the machine's monotonic clock; wall clock only.
  double session_s(double at_monotonic_s) const {
    return start_s_ + (at_monotonic_s - started_monotonic_s_);
  }

  /// Sets the current session time.
  void restart(double start_s) {
    *this = is_wall_ ? wall_from(start_s, monotonic_) : virtual_from(start_s);
  }

  /// Advances a virtual clock; no effect on a wall clock.
  void advance_to(double t_s) { now_s_ = std::max(now_s_, t_s); }

 private:
  SessionClock(bool is_wall, double start_s, double (*monotonic)() = monotonic_s)
      : is_wall_(is_wall),
        monotonic_(monotonic),
        start_s_(start_s),
        started_monotonic_s_(is_wall ? monotonic() : 0),
        now_s_(start_s) {}

  bool is_wall_;
  double (*monotonic_)();
  double start_s_, started_monotonic_s_, now_s_;
};

}  // namespace heft
