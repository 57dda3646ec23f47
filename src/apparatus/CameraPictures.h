// Pictures of a camera, a video file or a folder of images, tracked.
#pragma once

#include <functional>
#include <memory>

#include "apparatus/PictureRecording.h"
#include "apparatus/PictureTracker.h"
#include "tracking/Camera.h"

namespace heft {

class CameraPictures final : public PictureSource {
 public:
  using OpenCamera = std::function<std::unique_ptr<Camera>()>;

  /// @param open called once here, and for a file once more by each check(): what is looked at
  ///   before the session must not be missing from it
  /// @throws Error as open_camera
  CameraPictures(OpenCamera open, const PictureParts& parts);

  void begin_attempt(const AttemptStart& attempt) override;
  std::optional<Picture> next() override;
  void listen_anew() override;
  std::optional<double> rate_hz() const override;
  std::vector<CheckResult> check(double wanted_rate_hz) override;
  bool ended() const override { return camera_->ended(); }

 private:
  double time_of(const CameraPicture& taken);
  std::optional<Picture> picture_of_silence();

  OpenCamera open_;
  std::unique_ptr<Camera> camera_;
  Apparatus apparatus_;
  PictureTracker tracker_;
  std::optional<PictureRecording> recording_;
  const SessionClock& clock_;
  double attempt_start_s_ = 0;
  // A file's times go on from picture to picture; an attempt starts with the one after the last.
  std::optional<double> last_capture_s_, attempt_capture_s_;
  std::optional<std::int64_t> last_number_;
  double heard_s_ = 0;  ///< session time of the last sign of life of a live camera
};

}  // namespace heft
