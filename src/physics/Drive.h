// Drive alone owns stepping: it turns measured effector poses into steps of a simulator. Over
// video, physics runs from the last picture's capture time to this one's along the path between the
// two measured poses and is shown with this picture, so nothing is predicted and nothing lags
// (DESIGN: what is shown together belongs together). For see-through displays the poses between
// samples can be held or extrapolated, and every sample predicted to when it is seen. It reads no
// clock: live and replay feed it the same numbers and get the same bits.
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
  bool jump = false;    ///< the tracker says that the pose is not a continuation of the last one
};

/// The sample's pose carried on along its velocity for that long; 0 gives the pose itself.
Pose predicted(const TargetSample& sample, double ahead_s);

/// A pose of a made-up path, at rest; none: out of view.
TargetSample sample_of(double t_capture_s, const std::optional<Pose>& pose);

class Drive {
 public:
  /// @param rate_hz physics steps a second, at least; each picture takes ceil(dt * rate) equal
  /// steps
  /// @param input hold and extrapolate run a picture's steps with what was known at the last one
  /// @throws Error for a rate that is not above 0, or a prediction that is not 0 or above
  Drive(std::unique_ptr<DecouplingSimulator> simulator, const Scene& scene, double rate_hz,
        const DriveInput& input = {});

  /// The world at the sample's capture time, or `predict_s` after it. The first sample starts the
  /// world. A gap above 0.25 s counts as a jump; a jump teleports the clone. After the effector was
  /// out of view, or a jump, the clone touches nothing until it is clear of every cube. While it is
  /// out of view or jumps, the cubes go on with their motion and nothing touches them.
  /// @throws Error when time does not advance, or a tracked pose or velocity is not usable
  const WorldState& advance(const TargetSample& measured);

  /// Puts a cube back to its place in the scene, at rest. A clone that is there touches nothing
  /// until it is clear.
  /// @throws Error when there is no such cube
  void return_cube(int cube);

  const WorldState& state() const { return state_; }

  std::optional<SolveCounts> counts() const { return simulator_->counts(); }

 private:
  void start(const TargetSample& sample);
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
  TargetSample last_;  ///< as predicted
  std::optional<Velocity>
      mean_velocity_;  ///< mean, between the last two samples; none after a jump
  WorldState state_;
};

}  // namespace heft
