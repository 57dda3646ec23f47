// Opens a session's view, camera, responder and clock, before anything is logged, so that a missing
// camera or display leaves no session behind.
#pragma once

#include <memory>

#include "apparatus/configuration/ResolvedConfig.h"
#include "session/Runner.h"

namespace heft {

/// The part of the world that a cropped scene shows: the row with most cubes and as much as a gap
/// beside it, the front half of the resting effector, and whole cubes as far as they can be pushed.
Eigen::AlignedBox3d working_box(const Protocol& protocol);

class Equipment {
 public:
  /// @throws Error (device_missing) if a camera or display is missing; Error (invalid_file) if the
  ///   effector's size is not the protocol's
  explicit Equipment(ResolvedConfig config);
  Equipment(const Equipment&) = delete;

  SessionParts parts(Engine& engine, EventSink& sink);

  /// The checks before a session (DisplayCheck.h).
  std::vector<CheckResult> check();

  /// The configuration with the opened devices' facts.
  /// @throws Error (invalid_file) if the display is not the measured one
  SessionConfig logged_config() const {
    return with_devices(config_->config, {view_->display(), pictures_->rate_hz()});
  }

  SessionClock clock;

 private:
  ResolvedConfig config_;
  Apparatus demonstrated_;
  std::unique_ptr<Responder> responder_;
  std::unique_ptr<ArView> view_;
  std::unique_ptr<PictureSource> pictures_;
};

}  // namespace heft
