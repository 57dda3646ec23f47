// Replay: a log folded and simulated again. Verification compares every projected row with what the
// events give, and every picture's world with what its logged effector pose gives, and names the
// first difference.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "record/LogReader.h"
#include "replay/Projection.h"

namespace heft {

/// Where a log and its replay part.
struct Divergence {
  int trial_number = 0;  ///< 0: none
  double t_s = 0;        ///< session time
  std::string what;      ///< table and row, or picture
  std::string logged, came_out;
};

struct Verification {
  int n_events = 0, n_rows = 0, n_attempts = 0, n_pictures = 0;
  bool same_build = false;          ///< equal bits demanded; otherwise poses within 1e-6 m
  double largest_difference_m = 0;  ///< of any pose, where builds differ
  std::optional<Divergence> first;
};

/// @param progress called with the share of pictures done, 0...1
Verification verify_session(const LogReader& reader, std::int64_t session_id,
                            const std::function<void(double)>& progress);

}  // namespace heft
