// The check of the participant's display: a trial without a participant, on their window, at its
// size, with the session's pictures, physics and page. What it measures is what a trial does.
// Runs before a session with a person, and in `heft doctor`.
#pragma once

#include <vector>

#include "apparatus/SessionClock.h"
#include "apparatus/sources/PictureSource.h"
#include "protocol/Protocol.h"
#include "responders/Responder.h"
#include "view/ArView.h"

namespace heft {

/// Periods of the display after its capture; a frame that is presented later counts as late.
inline constexpr double late_periods = 2;

/// A picture that was displayed.
struct PresentedPicture {
  double capture_s = 0, present_s = 0;  ///< session time
  int n_dropped = 0;                    ///< pictures left out just before it
};

/// Judges the period between frames, the delay from a picture's capture to its presentation, and
/// dropped pictures. FAILED if the period is more than a tenth above the protocol's, or more than a
/// tenth of the pictures is dropped; a warning if one of a hundred is later than two periods, as
/// trials count late frames, or more than 2 % are dropped.
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

/// Checks the camera, if any, and then the view's display, if any. Pictures of a file are not taken
/// from the session: then the display is not measured, and the result says so.
std::vector<CheckResult> check_equipment(const DisplayedTrial& trial);

}  // namespace heft
