// Tracker "mouse": the participant drags the effector on the screen, for trials and teaching
// without camera or printed tags. A rendered camera films the table and the effector, without a
// hand. The pose is the true one, not tracked.
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
  /// @throws Error (usage) if there is no effector to drag
  explicit DraggedPictures(const PictureParts& parts);

  void begin_attempt(const AttemptStart& attempt) override;
  std::optional<Picture> next() override;
  void skip_to(double t_s) override { count_.skip_to(t_s); }
  void restart_count() override { count_.skipped(); }

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
  std::uint64_t number_ = 0;  // of the next camera picture
};

}  // namespace heft
