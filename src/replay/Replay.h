// Replay: a log folded and simulated again. Verification looks at digests and schema first, then
// compares every projected row with what the events give, then every frame's world with what its
// logged effector pose gives, and names the first difference.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "apparatus/LoggedSession.h"
#include "record/reader/LogReader.h"

namespace heft {

/// Where a log and its replay part.
struct Divergence {
  int trial_number = 0;  ///< 0: none
  double t_s = 0;        ///< session time
  std::string what;      ///< table and row, or frame
  std::string logged, came_out;
};

struct Verification {
  int n_events = 0, n_rows = 0, n_attempts = 0, n_frames = 0;
  bool ended = false;  ///< the session has its end; otherwise all there is was verified
  /// Frames of a simulator's edition that this program does not have: verified in all but their
  /// poses.
  int n_other_edition = 0;
  int n_other_build = 0;                  ///< frames that poses within 1e-6 m are demanded of
  double largest_difference_m = 0;        ///< of any of their poses
  double largest_of_other_edition_m = 0;  ///< of any pose that is only measured
  std::optional<Divergence> first;
};

/// @param progress called with the fraction of frames done, 0...1
Verification verify_session(const LogReader& reader, std::int64_t session_id,
                            const std::function<void(double)>& progress);

/// All of it but the frames' worlds.
Verification verify_rows(const LogReader& reader, const LoggedSession& session);

}  // namespace heft
