// Looks at a row of camera pictures and says whether an experiment can be run with them: camera,
// locks, rate, latency, light, print scale, board, jitter, effector, speed, each with a verdict and
// what was expected. Before a person's session, and in `heft doctor`.
#pragma once

#include <string>
#include <vector>

#include "experiment/EventPayloads.h"
#include "tracking/Tracker.h"
#include "tracking/camera/Camera.h"
#include "view/scene/SceneDrawing.h"

namespace heft {

/// What was seen of one picture, and how long it took.
struct LookedAt {
  double capture_s = 0;
  double waited_s = -1;   ///< from the middle of its exposure until it was there; below 0: unknown
  double brightness = 0;  ///< median gray, of 255
  double white_fraction = 0;  ///< of pixels
  TrackedPicture tracked;     ///< with its stages' times
  double tracked_in_s = 0;    ///< all of them, and what lies between
  double drawn_in_s = 0;      ///< cubes and clone over it
};

/// The wall time within which a picture should be tracked and drawn, by its size: 8 ms at 640 x 480
/// and 15 ms at 1280 x 720 (the project's goals for one core), others in proportion between.
double expected_time_s(const Intrinsics& camera);

class ApparatusCheck {
 public:
  explicit ApparatusCheck(const Apparatus& apparatus);

  /// Takes in one picture. @param waited_s from the middle of its exposure until it could be used;
  /// below 0: not known
  void see(const CameraPicture& picture, double waited_s);

  int n_pictures() const { return static_cast<int>(pictures_.size()); }

  /// @param wanted_rate_hz of the display  @param live whether rate and latency mean anything
  std::vector<CheckResult> results(const CameraMode& mode, double wanted_rate_hz, bool live) const;

 private:
  Apparatus apparatus_;
  Tracker tracker_;
  SceneDrawing drawing_;
  std::vector<LookedAt> pictures_;
  Image last_;  ///< picture
};

/// Takes pictures from a camera until there are enough, or it gives no more.
std::vector<CheckResult> check_camera(Camera& camera, const Apparatus& apparatus,
                                      double wanted_rate_hz);

// The verdicts, each from what was seen of a row of pictures (never none).

using Pictures = std::vector<LookedAt>;

/// Exposure, focus, white balance: a result each.
std::vector<CheckResult> lock_verdicts(const CameraMode& mode);
CheckResult rate_verdict(const Pictures& pictures, double wanted_rate_hz);
CheckResult light_verdict(const Pictures& pictures);
/// @param name of the result  @param what the body is called in messages
CheckResult print_scale_verdict(const MarkerBody& body, const char* name, const char* what);
/// @param seen the tone curve that the tracker has come to, of a camera whose file may have another
CheckResult tone_verdict(const Intrinsics& camera, const ToneCurve& seen);
/// @param why it may be that no picture shows the board
CheckResult board_verdict(const Pictures& pictures, const MarkerBody& board,
                          const std::string& why = "");
CheckResult jitter_verdict(const Pictures& pictures);
CheckResult effector_verdict(const Pictures& pictures, const std::string& why = "");
/// Of every stage from the camera to the drawn picture.
CheckResult latency_verdict(const Pictures& pictures);
CheckResult speed_verdict(const Pictures& pictures, const Intrinsics& camera,
                          double wanted_rate_hz);

}  // namespace heft
