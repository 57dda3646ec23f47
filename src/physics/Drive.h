// Drive alone owns stepping: it turns measured effector poses into steps of a simulator. Over
// video, physics runs from the last picture's capture time to this one's along the path between the
// two measured poses and is shown with this picture, so nothing is predicted and nothing lags
// (DESIGN: what is shown together belongs together). It reads no clock: live and replay feed it the
// same numbers and get the same bits.
#pragma once

#include <memory>
#include <vector>

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

class Drive {
 public:
  /// @param rate_hz physics steps a second, at least; each picture takes ceil(dt * rate) equal
  /// steps
  Drive(std::unique_ptr<DecouplingSimulator> simulator, const Scene& scene, double rate_hz);

  /// The world at the sample's capture time. The first sample starts the world. A gap above 0.25 s
  /// counts as a jump; a jump teleports the clone. After the effector was out of view, or a jump,
  /// the clone touches nothing until it is clear of every cube.
  /// @throws Error when time does not advance
  const WorldState& advance(const TargetSample& sample);

  /// Puts a cube back to its place in the scene, at rest.
  void return_cube(int cube);

  const WorldState& state() const { return state_; }

 private:
  void run(const TargetSample& sample);

  std::unique_ptr<DecouplingSimulator> simulator_;
  Scene scene_;
  double rate_hz_;
  bool started_ = false;
  bool solid_ = true;
  TargetSample last_;
  WorldState state_;
};

}  // namespace heft
