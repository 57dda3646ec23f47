// Everything that the study films and times: our tracker with its settings, and the comparisons,
// behind one face.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/Image.h"
#include "tracking/Tracker.h"

namespace heft {

struct MethodPoses {
  std::optional<Pose> camera_from_board, board_from_effector;
  double quality = 1;
};

/// What a method is, in the words of the charts and tables.
struct MethodName {
  std::string detector;    ///< "heft", "apriltag + solvePnP"...
  std::string refinement;  ///< "corners", "corners + bias removed", "edges", "edges + bias removed"
  double decimate = 1;
  bool region_of_interest = false;

  bool operator==(const MethodName&) const = default;
};

class TrackingMethod {
 public:
  virtual ~TrackingMethod() = default;
  virtual MethodPoses track(const Image& image, double t_s) = 0;
  virtual void reset() = 0;  ///< what comes next is no continuation
};

std::unique_ptr<TrackingMethod> make_method(const MethodName& name, const Apparatus& apparatus);

/// What our tracker does unless it is told otherwise.
MethodName our_method(int width_px);
/// AprilTag's corners and cv::solvePnP, decimated so that it keeps up: what most people build.
MethodName plain_method(int width_px);

/// Every detector, refinement and decimation; fewer where `quick`.
std::vector<MethodName> all_methods(int width_px, bool quick);

}  // namespace heft
