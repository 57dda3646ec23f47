// Looks at a row of camera pictures and says whether an experiment can be run with them: rate,
// light, board, print scale, effector, jitter, latency, each with a verdict. Before a person's
// session, and in `heft doctor`.
#pragma once

#include <string>
#include <vector>

#include "base/Names.h"
#include "tracking/Camera.h"
#include "tracking/Tracker.h"

namespace heft {

enum class Verdict { ok, warning, failed };
template <>
struct EnumNames<Verdict> {
  static constexpr std::array<std::string_view, 3> names{"ok", "warning", "failed"};
};

struct CheckResult {
  Verdict verdict = Verdict::ok;
  std::string name;     ///< "frame rate", "light"...
  std::string finding;  ///< the figure, and where it is not good what to do
};

/// JSON: {"name":..., "verdict":..., "finding":...}; the detail of a `check` event.
std::string to_json(const CheckResult& result);

class ApparatusCheck {
 public:
  explicit ApparatusCheck(const Apparatus& apparatus)
      : apparatus_(apparatus), tracker_(apparatus) {}

  /// Takes in one picture. @param waited_s from the middle of its exposure until it could be used;
  /// below 0: not known
  void see(const CameraPicture& picture, double waited_s);

  int n_pictures() const { return static_cast<int>(times_s_.size()); }

  /// @param wanted_rate_hz of the display  @param live whether rate and latency mean anything
  std::vector<CheckResult> results(const CameraMode& mode, double wanted_rate_hz, bool live) const;

 private:
  CheckResult rate(double wanted_rate_hz) const;
  CheckResult latency() const;
  CheckResult light() const;
  CheckResult board() const;
  CheckResult board_jitter() const;
  CheckResult print_scale() const;
  CheckResult effector() const;
  CheckResult detection_time(double wanted_rate_hz) const;

  Apparatus apparatus_;
  Tracker tracker_;
  std::vector<double> times_s_, waited_s_, tracked_in_s_;
  std::vector<double> brightness_, saturated_;  ///< of each picture: median gray, share of white
  std::vector<TrackedPicture> tracked_;
};

/// Takes pictures from a camera until there are enough, or it gives no more.
std::vector<CheckResult> check_camera(Camera& camera, const Apparatus& apparatus,
                                      double wanted_rate_hz);

}  // namespace heft
