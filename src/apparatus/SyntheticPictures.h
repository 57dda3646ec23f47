// Pictures of a synthetic camera that films the responder's hand, tracked like any other.
#pragma once

#include "apparatus/PictureRecording.h"
#include "apparatus/PictureTracker.h"
#include "tracking/SyntheticCamera.h"

namespace heft {

class SyntheticPictures final : public PictureSource {
 public:
  explicit SyntheticPictures(const PictureParts& parts);

  void begin_attempt(const AttemptStart& attempt) override;
  std::optional<Picture> next() override;
  void skip_to(double t_s) override { count_.skip_to(t_s); }
  void listen_anew() override;
  std::vector<CheckResult> check(double wanted_rate_hz) override;

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
