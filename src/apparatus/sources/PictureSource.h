// Where the runner's pictures come from: a camera and its tracker, a synthetic camera that films a
// model's hand, or that hand as it is. One table, in PictureSource.cpp, names them all.
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
#include "tracking/pose/MarkerBody.h"

namespace heft {

/// One picture, reduced to what the session needs of it.
struct Picture {
  TargetSample sample;  ///< t_capture_s: since the attempt's start
  std::string trouble;  ///< why it can't be used: "camera_lost", "board_lost"; empty: it can
  std::optional<double> quality;
  std::shared_ptr<const Image> camera;  ///< none: there is no camera
  std::optional<Pose> camera_from_board;
  int n_dropped = 0;  ///< of the camera's, since the picture before this one
};

/// Which attempt starts, and when in the session.
struct AttemptStart {
  double start_s = 0;
  int trial_number = 1, attempt = 1;
};

class PictureSource {
 public:
  virtual ~PictureSource() = default;

  /// Called when an attempt starts, before its first picture.
  virtual void begin_attempt(const AttemptStart& attempt) = 0;

  /// The next picture; times increase within an attempt. None: a live camera has no new one yet, or
  /// there will be no more.
  virtual std::optional<Picture> next() = 0;

  /// Pictures of before this time of the attempt are not worth making: a model's hand was not
  /// waited for. Only on a wall clock; a camera does so by itself.
  virtual void skip_to(double) {}

  /// What came until now was not listened to: the session was held, or a break taken. Nothing of it
  /// is dropped, and a camera or board that is missing now is missing since now.
  virtual void listen_again() {}

  /// Pictures a second that come by themselves, as the source tells; none: as many as are shown.
  virtual std::optional<double> rate_hz() const { return std::nullopt; }

  /// Looks at the camera before a session; nothing where there is none.
  /// @param wanted_rate_hz of the display
  virtual std::vector<CheckResult> check(double wanted_rate_hz [[maybe_unused]]) { return {}; }

  /// check() looks at something, which takes a while.
  virtual bool has_checks() const { return false; }

  /// No picture will come any more: the end of a file.
  virtual bool ended() const { return false; }
};

/// What pictures are made from.
struct PictureParts {
  const Protocol& protocol;
  Responder& hand;      ///< whose hand is filmed, where no real one is
  Apparatus apparatus;  ///< empty where the tracker uses none
  std::string what;     ///< what follows the colon: "camera:0"
  const SessionClock& clock;
  std::uint64_t seed = 0;  ///< the session's
  std::string record_to;   ///< a folder that the camera's pictures are kept in; empty: they are not
  std::string settings = {};  ///< contents of the file that `what` names, where it names settings
  bool left_hand = false;     ///< holds the effector, where a rendered camera films one
  /// What a person drags on the screen; none: there is no such window.
  std::shared_ptr<const DraggedEffector> dragged = {};
};

/// What follows the colon of a tracker's name.
enum class TrackerWhat {
  nothing,
  settings,  ///< a file of settings, or nothing
  source     ///< where the pictures come from
};

/// A row of the table of trackers.
struct TrackerEntry {
  std::string_view name;
  std::string_view summary;
  bool has_camera;  ///< needs camera, board and effector files
  bool is_live;     ///< pictures come when they come: the session runs on a wall clock
  TrackerWhat what;
  /// @throws Error (device_missing) when the camera is not there
  std::unique_ptr<PictureSource> (*make)(const PictureParts& parts);
  bool is_dragged = false;  ///< a person drags the effector in the window
};

std::span<const TrackerEntry> trackers();

/// @throws Error (usage) naming the nearest when there is none of that name
const TrackerEntry& tracker_named(std::string_view name);

/// The tracker's pictures, at the display's rate.
/// @throws Error as the tracker's `make`
std::unique_ptr<PictureSource> open_pictures(const TrackerEntry& tracker,
                                             const PictureParts& parts);

/// Numbers the pictures of a display's rate, from 0 at an attempt's start.
class PictureCount {
 public:
  explicit PictureCount(double rate_hz) : rate_hz_(rate_hz) {}

  void restart() { next_ = 0, n_skipped_ = 0; }
  std::uint64_t take() { return next_++; }
  double next_s() const { return time_s(next_); }
  double time_s(std::uint64_t number) const {
    return static_cast<double>(number) / rate_hz_;  // no accumulated rounding
  }
  /// The next one is not earlier than this time; nothing happens where it is not.
  void skip_to(double t_s);
  /// How many were skipped since the last time.
  int skipped() { return std::exchange(n_skipped_, 0); }

 private:
  double rate_hz_;
  std::uint64_t next_ = 0;
  int n_skipped_ = 0;
};

/// Tracker "hand": the responder's effector pose as it is, at the display's rate. No pixels.
class HandPictures final : public PictureSource {
 public:
  HandPictures(Responder& responder, double rate_hz) : responder_(responder), count_(rate_hz) {}

  void begin_attempt(const AttemptStart& attempt) override;
  std::optional<Picture> next() override;
  void skip_to(double t_s) override { count_.skip_to(t_s); }
  void listen_again() override { count_.skipped(); }

 private:
  Responder& responder_;
  PictureCount count_;
  TargetSample last_;
};

}  // namespace heft
