// What a session is run with, made from its options: the view, the camera, the responder, the
// clock. Made before the log is touched, so that a missing camera or display leaves no session
// behind.
#pragma once

#include <memory>

#include "apparatus/SessionSetup.h"
#include "session/Runner.h"

namespace heft {

class Equipment {
 public:
  /// @throws Error (device_missing) when a camera or display is not there; Error as complete()
  Equipment(std::shared_ptr<const Protocol> protocol, const SessionConfig& options,
            std::uint64_t seed);
  Equipment(const Equipment&) = delete;

  SessionParts parts(Engine& engine, EventSink& sink);

  /// The setup with what only the opened devices and the responder tell.
  /// @throws Error (invalid_file) when the display is not the one that was measured
  SessionConfig told_by_devices(const SessionConfig& setup) const {
    return with_display(with_participant(with_source_rate(setup, pictures_->rate_hz()), seed_),
                        view_->display());
  }

  SessionClock clock;

 private:
  std::shared_ptr<const Protocol> protocol_;
  std::uint64_t seed_;
  ViewSetup setup_;
  Apparatus demonstrated_;
  bool has_person_, left_hand_;
  bool has_screen_;
  std::unique_ptr<Responder> responder_;
  std::unique_ptr<ArView> view_;
  std::unique_ptr<PictureSource> pictures_;
};

}  // namespace heft
