// What somebody at the display saw of a logged attempt, and when.
#pragma once

#include <vector>

#include "apparatus/LoggedSession.h"
#include "replay/Projection.h"

namespace heft {

/// All that a row keeps of what was displayed.
DisplayedFrame displayed(const FrameRow& row);

/// The session folded, once its digests and its events are found sound: what is computed from
/// others would tell of a session that never was.
/// @throws Error (diverged) naming the first fault
Projection sound_fold(const LogReader& reader, const LoggedSession& session);

/// The attempt's frames up to an event of its session (counted from 0), without those that a
/// pause's page hid.
std::vector<DisplayedFrame> seen_frames(const AttemptFold& attempt,
                                        const std::vector<FrameRow>& rows, int up_to_event);

}  // namespace heft
