// Sources of the runner's pictures: a camera with its tracker, a synthetic camera that films a
// model's hand, or that hand's true pose. PictureSource.cpp has the table of all.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apparatus/SessionClock.h"
#include "apparatus/checks/ApparatusCheck.h"
#include "base/Image.h"
#include "experiment/Stage.h"
#include "physics/Drive.h"
#include "protocol/Protocol.h"
#include "responders/Responder.h"
#include "tracking/detection/MarkerBody.h"

namespace heft {

/// What the session needs of one picture.
struct Picture {
  TargetSample sample;                  ///< t_capture_s: since the attempt's start
  std::string trouble;                  ///< "camera_lost", "board_lost"; empty: usable
  std::optional<double> quality;        ///< of the effector's pose, 0 to 1
  std::shared_ptr<const Image> camera;  ///< none: no camera
  std::optional<Pose> camera_from_board;
  int n_dropped = 0;     ///< by the camera, since the previous picture
  bool doubled = false;  ///< a second print of a tag is in view
};

/// Interval at which a live source is asked for its next picture.
inline constexpr double look_up_s = 0.004;

/// The number of a trial before the session's trials, whose pictures are not recorded.
inline constexpr int before_trials = 0;

/// An attempt and its start.
struct AttemptStart {
  double start_s = 0;
  int trial_number = 1, attempt = 1;

  bool is_recorded() const { return trial_number != before_trials; }
};

class PictureSource {
 public:
  virtual ~PictureSource() = default;

  /// Called before an attempt's first picture.
  virtual void begin_attempt(const AttemptStart& attempt) = 0;

  /// The next picture; times increase within an attempt. None: a live camera has no new one yet, or
  /// the file has ended.
  virtual std::optional<Picture> next() = 0;

  /// A model's hand need not produce pictures before this time of the attempt. Wall clock only; no
  /// effect on a camera.
  virtual void skip_to(double) {}

  /// Pictures since the last call were ignored (held session, break). They do not count as dropped,
  /// and a missing camera or board counts as missing from now.
  virtual void restart_count() {}

  /// Rate of a live source in Hz; none: the display's rate.
  virtual std::optional<double> rate_hz() const { return std::nullopt; }

  /// Examines the camera before a session; no results without one.
  /// @param wanted_rate_hz of the display
  virtual std::vector<CheckResult> check(double wanted_rate_hz [[maybe_unused]]) { return {}; }

  /// Whether check() takes time to examine something.
  virtual bool has_checks() const { return false; }

  /// Whether pictures can be taken before the session without missing in it; false for a file.
  virtual bool is_endless() const { return true; }

  /// Whether the file has ended.
  virtual bool ended() const { return false; }
};

/// Everything that a picture source is made from.
struct PictureParts {
  const Protocol& protocol;
  Responder& hand;      ///< filmed instead of a real hand
  Apparatus apparatus;  ///< empty if the tracker uses none
  std::string what;     ///< the part after the colon, as in "camera:0"
  const SessionClock& clock;
  std::uint64_t seed = 0;     ///< the session's
  std::string record_to;      ///< folder for the camera's pictures; empty: not stored
  std::string settings = {};  ///< contents of the settings file that `what` names
  bool left_hand = false;     ///< whether the rendered hand is a left one
  /// Dragged on the screen by the participant; none without such a window.
  std::shared_ptr<const DraggedEffector> dragged = {};
};

/// What follows the colon of a tracker's name.
enum class TrackerWhat {
  nothing,
  settings,  ///< a settings file or nothing
  source     ///< the source of pictures
};

/// A row of the table of trackers.
struct TrackerEntry {
  std::string_view name;
  std::string_view summary;
  bool has_camera;  ///< needs camera, board and effector files
  bool is_live;     ///< pictures arrive in real time: the session runs on a wall clock
  TrackerWhat what;
  /// @throws Error (device_missing) if the camera is missing
  std::unique_ptr<PictureSource> (*make)(const PictureParts& parts);
  bool is_dragged = false;  ///< the participant drags the effector in the window
  /// false: only the strokes of a model's hand are computed (session/SurrogateAttempt.h).
  bool has_pictures = true;
};

std::span<const TrackerEntry> trackers();

/// @throws Error (usage) suggesting the most similar name if there is none of that name
const TrackerEntry& tracker_named(std::string_view name);

/// The tracker's pictures, at the display's rate.
/// @throws Error as the tracker's `make`
std::unique_ptr<PictureSource> open_pictures(const TrackerEntry& tracker,
                                             const PictureParts& parts);

/// Numbers the pictures at the display's rate, from 0 at an attempt's start.
class PictureCount {
 public:
  explicit PictureCount(double rate_hz) : rate_hz_(rate_hz) {}

  void restart() { next_ = 0, n_skipped_ = 0; }
  std::uint64_t take() { return next_++; }
  double next_s() const { return time_s(next_); }
  double time_s(std::uint64_t number) const {
    return static_cast<double>(number) / rate_hz_;  // no accumulated rounding
  }
  /// The next picture is not earlier than this time.
  void skip_to(double t_s);
  /// Number of skipped pictures since the last call.
  int skipped() { return std::exchange(n_skipped_, 0); }

 private:
  double rate_hz_;
  std::uint64_t next_ = 0;
  int n_skipped_ = 0;
};

/// Tracker "hand": the responder's true effector pose at the display's rate, without pixels.
class HandPictures : public PictureSource {
 public:
  HandPictures(Responder& responder, double rate_hz) : responder_(responder), count_(rate_hz) {}

  void begin_attempt(const AttemptStart& attempt) override;
  std::optional<Picture> next() override;
  void skip_to(double t_s) override { count_.skip_to(t_s); }
  void restart_count() override { count_.skipped(); }

 private:
  Responder& responder_;
  PictureCount count_;
  TargetSample last_;
};

}  // namespace heft
