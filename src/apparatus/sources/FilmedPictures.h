// Tracked pictures of a camera, a video file, a folder of images or a synthetic camera.
#pragma once

#include <functional>
#include <memory>

#include "apparatus/sources/PictureRecording.h"
#include "apparatus/sources/PictureSource.h"
#include "tracking/Tracker.h"
#include "tracking/camera/Camera.h"
#include "tracking/pose/PoseFilter.h"
#include "tracking/synthetic/SyntheticCamera.h"

namespace heft {

/// The filtered pose of the effector, as input for Drive.
TargetSample smoothed(PoseFilter& filter, const TrackedPicture& tracked, double t_s);

/// Converts a camera's picture to the session's Picture: tracks board and effector, filters the
/// effector's pose without lag, and detects a lost board.
class PictureTracker {
 public:
  explicit PictureTracker(const Apparatus& apparatus) : tracker_(apparatus) {}

  /// @param t_s of its capture, increasing; also the time of Picture::sample
  Picture track(std::shared_ptr<const Image> image, double t_s);

  /// Restarts the count of the board's time out of view.
  void look_again() { board_seen_s_.reset(); }

  /// The next picture does not continue the previous ones.
  void reset();

 private:
  Tracker tracker_;
  PoseFilter filter_;
  TargetSample sample_;  ///< the last one
  std::optional<Pose> camera_from_board_;
  std::optional<double> board_seen_s_;
};

/// Pictures of a camera, a video file or a folder of images.
class CameraPictures final : public PictureSource {
 public:
  using OpenCamera = std::function<std::unique_ptr<Camera>()>;

  /// @param open called once here, and again for a file by each check(), so that the check takes no
  ///   pictures from the session
  /// @throws Error as open_camera
  CameraPictures(OpenCamera open, const PictureParts& parts);

  void begin_attempt(const AttemptStart& attempt) override;
  std::optional<Picture> next() override;
  void restart_count() override;
  std::optional<double> rate_hz() const override;
  std::vector<CheckResult> check(double wanted_rate_hz) override;
  bool has_checks() const override { return true; }
  bool is_endless() const override { return camera_->is_live(); }
  bool ended() const override { return camera_->ended(); }

 private:
  double time_of(const CameraPicture& taken);
  std::optional<Picture> lost_picture();

  OpenCamera open_;
  std::unique_ptr<Camera> camera_;
  Apparatus apparatus_;
  PictureTracker tracker_;
  std::optional<PictureRecording> recording_;
  const SessionClock& clock_;
  AttemptStart attempt_;
  // A file's times continue between attempts; an attempt starts with the next picture.
  std::optional<double> last_capture_s_, attempt_capture_s_;
  std::optional<std::int64_t> last_number_;
  double last_picture_s_ = 0;  ///< session time of the last picture of a live camera
};

/// Pictures of a synthetic camera that films the responder's hand.
class SyntheticPictures final : public PictureSource {
 public:
  explicit SyntheticPictures(const PictureParts& parts);

  void begin_attempt(const AttemptStart& attempt) override;
  std::optional<Picture> next() override;
  void skip_to(double t_s) override { count_.skip_to(t_s); }
  void restart_count() override;
  std::vector<CheckResult> check(double wanted_rate_hz) override;
  bool has_checks() const override { return true; }

 private:
  Responder& hand_;
  Apparatus apparatus_;
  SyntheticSettings settings_;
  SyntheticCamera camera_;
  PictureTracker tracker_;
  std::optional<PictureRecording> recording_;
  AttemptStart attempt_;
  PictureCount count_;
};

}  // namespace heft
