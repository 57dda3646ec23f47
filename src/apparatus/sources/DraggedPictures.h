// Tracker "mouse": the effector that a person drags on the screen, to try and to teach without a
// camera or a print. A rendered camera films the table and the effector, and no hand, which would
// be nobody's; its pose is the one that it has, not a tracked one.
#pragma once

#include <memory>
#include <optional>

#include "apparatus/sources/PictureRecording.h"
#include "apparatus/sources/PictureSource.h"
#include "experiment/Stage.h"
#include "tracking/synthetic/SyntheticCamera.h"

namespace heft {

class DraggedPictures final : public PictureSource {
 public:
  /// @throws Error (usage) where there is no effector to drag
  explicit DraggedPictures(const PictureParts& parts);

  void begin_attempt(const AttemptStart& attempt) override;
  std::optional<Picture> next() override;
  void skip_to(double t_s) override { count_.skip_to(t_s); }
  void listen_again() override { count_.skipped(); }

 private:
  std::shared_ptr<const Image> filmed(const Pose& effector, double t_s);

  std::shared_ptr<const DraggedEffector> effector_;
  SyntheticSettings settings_;
  SyntheticCamera camera_;
  const SessionClock& clock_;
  std::optional<PictureRecording> recording_;
  AttemptStart attempt_;
  PictureCount count_;
  std::optional<TargetSample> last_;
  std::uint64_t number_ = 0;  // of the camera's pictures
};

}  // namespace heft
