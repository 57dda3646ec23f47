// The visible geometry of a trial: what anyone at the table can see and measure.
// All that a mind receives of the world: poses as drawn, a tracking flag, the time. No mass, force
// or condition.
// An effector that nobody holds: a person drags it on the screen. The view moves it, the pictures
// of the tracker "mouse" show it where it is.
// A display as the window system tells of it. How large it is in millimeters nobody tells reliably:
// that is measured (heft calibrate display).
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "base/PoseTypes.h"

namespace heft {

struct Stage {
  Eigen::Vector3d effector_size_m{0.09, 0.04, 0.04};  ///< along its own x (towards the tip), y, z
  double cube_size_m = 0.035;
  std::vector<Eigen::Vector3d> slots_m;  ///< centers of the cubes' starting places, leftmost first
  double start_distance_m = 0.06;  ///< from the cubes' near faces to the resting effector's tip
  double display_rate_hz = 15;

  int n_slots() const { return static_cast<int>(slots_m.size()); }
};

struct DisplayedFrame {
  double t_s = 0;             ///< since the trial's start
  bool tracked = true;        ///< false: the effector is out of the camera's view
  Pose effector;              ///< the filmed effector; meaningless when not tracked
  std::optional<Pose> clone;  ///< absent: not drawn
  std::vector<Pose> cubes;    ///< by slot, leftmost first; empty until they appear
};

struct DraggedEffector {
  Pose pose;  ///< board frame
};

struct DisplayFacts {
  int number = 0;  ///< from 0, as --display takes it
  std::string name;
  int w_px = 0, h_px = 0;
  std::optional<double> refresh_hz;
  double scale = 1;  ///< pixels a unit of the window system
};

/// A display as it was measured; a file holds it.
struct DisplayMeasures {
  int w_px = 0, h_px = 0;
  double w_mm = 0, h_mm = 0;
  double eye_distance_mm = 0;
};

}  // namespace heft
