// What is visible in a trial, and the display that shows it. No mass, force or condition.
#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/PoseTypes.h"

namespace heft {

/// Geometry of a trial's scene.
struct Stage {
  Eigen::Vector3d effector_size_m{0.09, 0.04, 0.04};  ///< along its x (towards the tip), y, z
  double cube_size_m = 0.035;
  std::vector<Eigen::Vector3d> slots_m;  ///< centers of the cubes' starting places, leftmost first
  double start_distance_m = 0.06;  ///< from the cubes' near faces to the resting effector's tip
  double display_rate_hz = 15;

  int n_slots() const { return static_cast<int>(slots_m.size()); }
};

/// A displayed frame, as a responder perceives it.
struct DisplayedFrame {
  double t_s = 0;             ///< since the trial's start
  bool tracked = true;        ///< false: the effector is not seen by the camera
  Pose effector;              ///< the filmed effector; undefined when not tracked
  std::optional<Pose> clone;  ///< none: not drawn
  std::vector<Pose> cubes;    ///< by slot, leftmost first; empty before they are shown
};

/// An effector that is dragged on the screen: the view moves it, the tracker "mouse" reads it.
struct DraggedEffector {
  Pose pose;  ///< board frame
};

/// A display as the window system reports it. Its size in millimeters is not reported reliably and
/// must be measured (heft calibrate display).
struct DisplayFacts {
  int number = 0;  ///< from 0; the argument of --display
  std::string name;
  int w_px = 0, h_px = 0;
  std::optional<double> refresh_hz;
  double scale = 1;  ///< pixels per unit of the window system
};

/// How late a display shows a frame, from its presentation: to its light (mean), and to the arrival
/// of a camera's picture of it (median, 5 % and 95 %).
inline constexpr std::array<const char*, 4> latency_names{"light_ms", "picture_ms", "picture_p5_ms",
                                                          "picture_p95_ms"};

/// Measured display, read from a file.
struct DisplayMeasures {
  int w_px = 0, h_px = 0;
  double w_mm = 0, h_mm = 0;
  double eye_distance_mm = 0;
  std::map<std::string, double> latency_ms{};  ///< by latency_names; empty: not measured
};

}  // namespace heft
