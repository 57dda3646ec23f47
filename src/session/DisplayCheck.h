// The check of the participant's display: a trial without a participant, in the session's window,
// with its pictures, physics and page. Runs before a session with a person, and in `heft doctor`.
#pragma once

#include <vector>

#include "apparatus/SessionClock.h"
#include "apparatus/sources/PictureSource.h"
#include "protocol/Protocol.h"
#include "responders/Responder.h"
#include "view/ArView.h"

namespace heft {

/// A frame counts as late if it is presented more than this many periods of the display after its
/// capture.
inline constexpr double late_periods = 2;

/// A picture that was displayed.
struct PresentedPicture {
  double capture_s = 0, present_s = 0;  ///< session time
  int n_dropped = 0;                    ///< pictures left out just before it
};

/// Judges the period between frames, the delay from a picture's capture to its presentation, and
/// dropped pictures. FAILED if the period is more than a tenth above the protocol's, or more than a
/// tenth of the pictures is dropped; a warning if more than 1 % are late or more than 2 % dropped.
/// @param wanted_rate_hz the protocol's display_rate_hz
CheckResult display_verdict(const std::vector<PresentedPicture>& pictures, double wanted_rate_hz);

/// What a trial is displayed with.
struct DisplayedTrial {
  const Protocol& protocol;
  PictureSource& pictures;
  Responder& hand;  ///< filmed if no real hand is
  ArView& view;
  SessionClock& clock;  ///< a wall clock
};

/// Checks the camera, if any, and then the view's display, if any. With pictures from a file, which
/// the session needs, the display is not measured, and the result says so.
std::vector<CheckResult> check_equipment(const DisplayedTrial& trial);

}  // namespace heft
