// How well each participant's effector was tracked: what a reviewer holds beside their figures.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/Fold.h"

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
class TrackingFold {
 public:
  void add(const SessionData& data);
  std::vector<PersonTracking> result() const;

 private:
  std::map<std::string, PersonTracking> people_;
};

inline std::vector<PersonTracking> tracking_of(std::span<const SessionData> sessions) {
  return folded<TrackingFold>(sessions);
}

}  // namespace heft
