// The opened view, camera, responder and clock of a session. Made before the log is touched, so
// that a missing camera or display leaves no session behind.
#pragma once

#include <memory>

#include "apparatus/configuration/ResolvedConfig.h"
#include "session/Runner.h"

namespace heft {

class Equipment {
 public:
  /// @throws Error (device_missing) when a camera or display is not there; Error (invalid_file)
  ///   when the effector is not the protocol's
  explicit Equipment(ResolvedConfig config);
  Equipment(const Equipment&) = delete;

  SessionParts parts(Engine& engine, EventSink& sink);

  /// The configuration with what only the opened devices know.
  /// @throws Error (invalid_file) when the display is not the one that was measured
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
