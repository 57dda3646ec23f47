// How well each participant's effector was tracked: what a reviewer holds beside their figures.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/Dataset.h"

namespace heft {

struct PersonTracking {
  std::string participant;
  TrackingCounts counts;
  PictureCounts pictures;  ///< of the camera; none for simulated participants

  /// Of the time from all cubes shown to the answer, without pauses; none without such a time.
  std::optional<double> in_view_percent() const;
  std::optional<double> tracked_percent() const;  ///< of frames, where they were kept
};

/// By participant.
std::vector<PersonTracking> tracking_of(std::span<const SessionData> sessions);

}  // namespace heft
