// A hand's way through space: straight minimum-jerk movements with rests between them.
#pragma once

#include <vector>

#include "base/PoseTypes.h"

namespace heft {

/// Fraction of the way after a fraction u (held in 0...1) of the time: 10u^3 - 15u^4 + 6u^5
/// (Flash and Hogan 1985).
double minimum_jerk(double u);

/// Duration of a minimum-jerk movement: its peak speed is 15/8 of its mean speed.
double minimum_jerk_duration_s(double distance_m, double peak_speed_m_s);

struct HandMove {
  double start_s = 0, duration_s = 0;
  Pose from, to;
};

class HandPath {
 public:
  explicit HandPath(const Pose& start) : start_(start) {}

  /// Forgets the movements made so far; the next one starts where they ended, at t_s or later.
  void begin_at(double t_s);
  void wait(double duration_s) { end_s_ += duration_s; }
  void move(const Pose& to, double peak_speed_m_s);

  Pose at(double t_s) const;
  double end_s() const { return end_s_; }
  const Pose& end() const { return moves_.empty() ? start_ : moves_.back().to; }
  const std::vector<HandMove>& moves() const { return moves_; }

 private:
  Pose start_;
  std::vector<HandMove> moves_;
  double end_s_ = 0;
};

}  // namespace heft
