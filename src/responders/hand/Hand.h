// A simulated hand: rests in front of the row, pushes the cubes it sees away from the participant,
// lifts over everything between pushes, and returns. Its pose is a pure function of time and of the
// displayed frames so far. It does not know the answers.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "base/PoseTypes.h"
#include "base/Random.h"
#include "experiment/Stage.h"
#include "responders/ResponderParameters.h"

namespace heft {

/// Fraction of the distance after a fraction u (clamped to 0...1) of the time: 10u^3 - 15u^4 + 6u^5
/// (Flash and Hogan 1985).
double minimum_jerk(double u);

/// Duration of a minimum-jerk movement: its peak speed is 15/8 of its mean speed.
double minimum_jerk_duration_s(double distance_m, double peak_speed_m_s);

struct HandMove {
  double start_s = 0, duration_s = 0;
  Pose from, to;
};

/// A hand's path: straight minimum-jerk movements with rests between them.
class HandPath {
 public:
  explicit HandPath(const Pose& start) : start_(start) {}

  /// Removes past movements; the next one starts where they ended, at t_s or later.
  void begin_at(double t_s);
  void wait(double duration_s) { end_s_ += duration_s; }
  /// Stands still from t_s on, wherever it is then.
  void stop_at(double t_s);
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

/// The effector at rest before a trial: its tip away from the participant, start_distance_m in
/// front of the row's middle, hover_m above the table.
Pose resting_pose(const Stage& stage, double hover_m);

class Hand {
 public:
  Hand(const ResponderParameters& parameters, std::uint64_t seed, const TrialView& trial);

  /// Starts to push these cubes (from 0), one after the other in drawn order.
  void explore(std::span<const int> cubes);

  /// Processes a frame; plans the next movement when the last one has ended.
  void see(const DisplayedFrame& frame);

  Pose at(double t_s) const { return path_.at(t_s); }
  /// Whether it is back at rest with nothing left to push.
  bool done(double t_s) const;
  /// Movements planned last.
  const HandPath& path() const { return path_; }

  /// Effector poses at both ends of a push along +y.
  struct Stroke {
    int cube = 0;  ///< from 0
    Pose start, end;
    double begins_s = 0;
    double peak_speed_m_s = 0;
    Eigen::Vector3d cube_start_m{0, 0, 0};
    bool stopped = false;  ///< before its planned end
  };
  /// The push at the end of the last planned movement; none: the movement is no push.
  const std::optional<Stroke>& stroke() const { return pushed_; }

 private:
  std::optional<Stroke> next_stroke(std::span<const Pose> cubes);
  std::optional<Stroke> stroke_on(int cube, std::span<const Pose> cubes);
  Stroke aimed(int cube, const Pose& at, double lateral_m, double yaw_rad, double length_m) const;
  bool possible(const Stroke& stroke, std::span<const Pose> cubes) const;
  void push(const Stroke& stroke, std::span<const Pose> cubes);
  bool has_seen_enough(const DisplayedFrame& frame) const;
  void stop(double t_s);
  void back_off(std::span<const Pose> cubes);
  Eigen::Vector3d half_extents_of(const Pose& cube) const;
  double near_face_m(const Pose& cube) const;
  double tip_m(const Pose& effector) const;
  double safe_height_m(std::span<const Pose> cubes) const;
  void travel_to(const Pose& place, std::span<const Pose> cubes);
  void go_home(std::span<const Pose> cubes);
  double varied(double mean);
  double error(double sd);

  ResponderParameters parameters_;
  Stage stage_;
  RandomStream stream_;
  Pose home_;
  HandPath path_;
  std::deque<int> to_push_;  ///< cubes, one entry per stroke
  bool at_home_ = true;
  std::optional<Stroke> pushed_;
};

}  // namespace heft
