// Drive turns measured effector poses into steps of a simulator. Over video, physics runs from the
// capture time of the last picture to that of this one, along the path between the two measured
// poses, and is shown with this picture; so there is no prediction and no lag. For optical
// see-through displays, poses between samples can be held or extrapolated, and samples predicted to
// the time of display. Drive reads no clock: a replay computes the same bits as the session.
#pragma once

#include <memory>
#include <optional>

#include "base/SimulationChoices.h"
#include "physics/DecouplingSimulator.h"

namespace heft {

/// One measured effector pose.
struct TargetSample {
  double t_capture_s = 0;
  Pose pose;
  Velocity velocity;
  bool tracked = true;  ///< false: out of view; pose and velocity are not used
  bool jump = false;    ///< the pose does not continue the last one, according to the tracker
};

/// The sample's pose after ahead_s seconds at its velocity; 0 gives the pose itself.
Pose predicted(const TargetSample& sample, double ahead_s);

/// A sample of a synthetic path, with zero velocity; none: out of view.
TargetSample sample_of(double t_capture_s, const std::optional<Pose>& pose);

/// A longer gap between two samples is a jump. Allows for rounding of time differences.
inline constexpr double longest_gap_s = 0.25 + 1e-6;

class Drive {
 public:
  /// @param rate_hz lower bound of the physics rate; a picture takes ceil(dt * rate) equal steps
  /// @throws Error for a rate that is not above 0 or a negative prediction; OutsideModel for an
  /// instability()
  Drive(std::unique_ptr<DecouplingSimulator> simulator, const Scene& scene, double rate_hz,
        const DriveInput& input = {});

  /// The world at the sample's capture time plus `predict_s`. The first sample starts the world. A
  /// gap above 0.25 s is a jump, and a jump teleports the clone. After a jump or a loss of the
  /// effector, the clone touches nothing until it is clear of every cube; meanwhile the cubes keep
  /// moving.
  /// @throws Error if time does not advance, or a tracked pose or velocity is not usable
  const WorldState& advance(const TargetSample& measured);

  /// Returns a cube to its start pose, at rest. If the clone is in the way, it touches nothing
  /// until it is clear of every cube.
  /// @throws Error if there is no such cube
  void return_cube(int cube);

  const WorldState& state() const { return state_; }

  std::optional<SolveCounts> counts() const { return simulator_->counts(); }

 private:
  void start(const TargetSample& sample);
  void follow(const TargetSample& sample);
  Pose end_of_path(const TargetSample& sample) const;
  void run(const Pose& target, double dt_s, const std::optional<Velocity>& at_target);
  void read_state();
  void set_solid(bool solid);
  bool clear_of_cubes() const;

  std::unique_ptr<DecouplingSimulator> simulator_;
  Scene scene_;
  double rate_hz_;
  DriveInput input_;
  bool started_ = false;
  bool solid_ = true;
  TargetSample last_;                      ///< with predicted pose
  std::optional<Velocity> mean_velocity_;  ///< between the last two samples; none after a jump
  WorldState state_;
};

}  // namespace heft
