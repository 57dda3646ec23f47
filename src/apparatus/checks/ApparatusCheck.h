// Examines a series of camera pictures and judges whether they suffice for an experiment: camera,
// locked settings, rate, latency, light, noise, ghosting, flicker, gain, lost pictures, sharpness,
// doubles, print scale, board, tag size, focal length, jitter, effector, speed. Each verdict states
// the finding and what was expected. Runs before a session and in `heft doctor`.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "experiment/EventPayloads.h"
#include "tracking/Tracker.h"
#include "tracking/camera/Camera.h"
#include "view/scene/SceneDrawing.h"

namespace heft {

/// Measurements of one picture and its processing times.
struct LookedAt {
  double capture_s = 0;
  std::int64_t number = 0;    ///< as the camera counts
  double waited_s = -1;       ///< from mid-exposure to delivery; below 0: unknown
  double brightness = 0;      ///< median gray, of 255
  double white_fraction = 0;  ///< of pixels
  /// Light relative to the last picture's, as a logarithm: its median, and its SD over rows.
  double brighter = 0, banded = 0;
  TrackedPicture tracked;   ///< with its stages' times
  double tracked_in_s = 0;  ///< all stages and the time between them
  double drawn_in_s = 0;    ///< cubes and clone over the picture
};

/// Wall time within which a picture should be tracked and drawn: 8 ms at 640 x 480 and 15 ms at
/// 1280 x 720 (the project's goals for one core), interpolated by the number of pixels.
double expected_time_s(const Intrinsics& camera);

class ApparatusCheck {
 public:
  explicit ApparatusCheck(const Apparatus& apparatus);

  /// Processes one picture. @param waited_s from mid-exposure to delivery; below 0: unknown
  void see(const CameraPicture& picture, double waited_s);

  int n_pictures() const { return static_cast<int>(pictures_.size()); }

  /// @param wanted_rate_hz of the display  @param live whether rate and latency are meaningful
  std::vector<CheckResult> results(const CameraMode& mode, double wanted_rate_hz, bool live) const;

 private:
  Apparatus apparatus_;
  Tracker tracker_;
  SceneDrawing drawing_;
  std::vector<LookedAt> pictures_;
  Image last_;                      ///< the last picture
  std::vector<double> last_light_;  ///< of its blocks
};

/// Takes pictures until there are enough, or the camera delivers no more.
std::vector<CheckResult> check_camera(Camera& camera, const Apparatus& apparatus,
                                      double wanted_rate_hz);

/// How late the participant's display shows a frame, by a camera that looks at it
/// (DisplayDelay.cpp).
struct DisplayDelay {
  /// For each change of the patch that was seen: time from the frame's presentation to its light,
  /// halfway between the last picture without and the first one with it, and to that picture's
  /// arrival. A single time is uncertain by half the time between pictures; their mean is not,
  /// because the changes come at random moments.
  std::vector<double> light_s, picture_s;
  double between_pictures_s = 0;  ///< median
  int n_missed = 0;               ///< changes that no picture showed in time

  double mean_light_s() const;
  /// By latency_names (Stage.h). @pre some change was seen
  std::map<std::string, double> figures_ms() const;
};

/// Takes half a second for each change.
/// @param camera live, looking at the display
/// @param present draws a frame whose patch has the other color; returns when it was presented
/// @throws Error if no part of the picture changes with the patch, with advice
DisplayDelay measure_display_delay(Camera& camera, const std::function<double()>& present,
                                   int n_changes);
CheckResult delay_verdict(const DisplayDelay& delay);

/// Delays of --events on this machine, of each kind of outlet (OutletDelays.cpp).
std::vector<CheckResult> outlet_verdicts();

// Verdicts on a series of at least one picture.

using Pictures = std::vector<LookedAt>;

/// One result for each control: exposure, focus, white balance, gain, power line, dynamic frame
/// rate.
std::vector<CheckResult> lock_verdicts(const CameraMode& mode);
CheckResult rate_verdict(const Pictures& pictures, double wanted_rate_hz);
CheckResult light_verdict(const Pictures& pictures);
/// Blur of the board's edges; pictures without the board do not count.
CheckResult sharpness_verdict(const Pictures& pictures);
CheckResult noise_verdict(const Pictures& pictures);
/// Mixing of successive pictures by the camera's temporal denoising.
CheckResult ghosting_verdict(const Pictures& pictures);
CheckResult flicker_verdict(const Pictures& pictures);
CheckResult gain_verdict(const Pictures& pictures);
/// Lost or repeated, by the pictures' times and numbers.
CheckResult lost_verdict(const Pictures& pictures);
/// Changes of the focal length by a lens that refocuses, from the board's perspective.
CheckResult breathing_verdict(const Pictures& pictures);
inline constexpr int light_block_px = 16;
/// Light of a picture's square blocks, row by row, from its first channel.
std::vector<double> light_of_blocks(const Image& image);
/// Sets brighter and banded. @param n_across blocks of a row
void compare_light(const std::vector<double>& before, const std::vector<double>& now, int n_across,
                   LookedAt& seen);
/// Second prints with the numbers of the board's or the effector's tags.
CheckResult doubles_verdict(const Pictures& pictures);
/// Size of the board's tags relative to the distances between them.
CheckResult tag_size_verdict(const Pictures& pictures);
/// @param name of the result  @param what name of the body in messages
CheckResult print_scale_verdict(const MarkerBody& body, const char* name, const char* what);
/// @param seen the tone curve that the tracker estimated; the camera file may hold another one
CheckResult tone_verdict(const Intrinsics& camera, const ToneCurve& seen);
/// @param why possible reason that no picture shows the board
CheckResult board_verdict(const Pictures& pictures, const MarkerBody& board,
                          const std::string& why = "");
CheckResult jitter_verdict(const Pictures& pictures);
CheckResult effector_verdict(const Pictures& pictures, const std::string& why = "");
/// Latency of all stages from the camera to the drawn picture.
CheckResult latency_verdict(const Pictures& pictures);
CheckResult speed_verdict(const Pictures& pictures, const Intrinsics& camera,
                          double wanted_rate_hz);

}  // namespace heft
