// Trackers as people usually build them, to compare ours with on the same pictures. They exist for
// the charts of `heft bench tracking` alone; no session can choose them. One table, in
// ComparisonTracker.cpp, names them all.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "base/Image.h"
#include "base/PoseTypes.h"
#include "tracking/detection/MarkerBody.h"
#include "tracking/detection/TagDetector.h"

namespace heft {

struct ComparisonPoses {
  std::optional<Pose> camera_from_board, camera_from_effector;
};

/// Each picture on its own. One is used by one thread.
class ComparisonTracker {
 public:
  virtual ~ComparisonTracker() = default;
  virtual ComparisonPoses track(const Image& image) = 0;

  /// The tags of the board's family, as its detector saw them in the last picture.
  virtual const std::vector<DetectedTag>& tags() const = 0;
};

/// A row of the table of comparisons.
struct ComparisonEntry {
  std::string_view name;     ///< "apriltag + solvePnP"
  std::string_view summary;  ///< how the poses come about
  bool can_decimate;
  /// @param decimate as in TagDetector.h; without meaning for those that can't
  /// @throws Error for an apparatus whose family the detector does not have
  std::unique_ptr<ComparisonTracker> (*make)(const Apparatus& apparatus, double decimate);
};

/// Without OpenCV's aruco module at build time, those that need it are missing.
std::span<const ComparisonEntry> comparison_trackers();

/// Whether the aruco comparisons are in the table.
bool has_aruco();

/// Keeps OpenCV on the caller's thread from now on, so that a thread's CPU time is all that its
/// functions take.
void keep_opencv_on_one_thread();

}  // namespace heft
