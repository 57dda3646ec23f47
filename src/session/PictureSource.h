// Where the runner's pictures come from. Today a responder's hand taken as it is; a camera and its
// tracker give the same.
#pragma once

#include <optional>
#include <string>

#include "physics/Drive.h"
#include "responders/Responder.h"

namespace heft {

/// One picture, reduced to what the session needs of it.
struct Picture {
  TargetSample sample;  ///< t_capture_s: since the attempt's start
  std::string trouble;  ///< why it can't be used: "camera_lost", "board_lost"; empty: it can
  std::optional<double> quality;
};

class PictureSource {
 public:
  virtual ~PictureSource() = default;

  /// Called when an attempt starts, before its first picture.
  virtual void begin_attempt() = 0;

  /// The next picture; times increase within an attempt.
  virtual Picture next() = 0;
};

/// Tracker "hand": the responder's effector pose as it is, at the display's rate. No pixels.
class HandPictures final : public PictureSource {
 public:
  HandPictures(Responder& responder, double rate_hz) : responder_(responder), rate_hz_(rate_hz) {}

  void begin_attempt() override;
  Picture next() override;

 private:
  Responder& responder_;
  double rate_hz_;
  int count_ = 0;
  TargetSample last_;
};

}  // namespace heft
