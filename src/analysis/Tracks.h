// The courses of one session's staircases, for looking at.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/Dataset.h"

namespace heft {

struct TrackPoint {
  double level_g = 0;   ///< as presented
  bool wrong = false;   ///< the lighter cube was chosen
  bool chosen = false;  ///< a cube was; otherwise "no difference"
  bool is_reversal = false;
};

struct Track {
  std::string staircase;
  double reference_g = 0;
  std::vector<TrackPoint> points;  ///< the staircase's completed trials in order
  std::optional<double> jnd_g;     ///< where `censored`, what it lies beyond
  Censored censored = Censored::none;
};

struct SessionTracks {
  std::int64_t session_id = 0;
  std::string participant;
  bool simulated = false;
  std::vector<Track> tracks;  ///< by reference, then name
};

/// Every session that has staircases that estimate a JND.
std::vector<SessionTracks> all_tracks(std::span<const SessionData> sessions);

/// The first finished session that has staircases that estimate a JND, or else the first that has
/// any.
std::optional<SessionTracks> example_tracks(std::span<const SessionData> sessions);

}  // namespace heft
