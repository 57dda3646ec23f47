// How long a session will be: a forecast for planning, not a promise.
#pragma once

#include <map>
#include <string>

#include "protocol/Protocol.h"

namespace heft {

/// Seconds that a trial takes on average, by task.
using TrialDurations = std::map<std::string, double>;

/// What the tasks assume: the paper sets no time limit and gives no times. Replace them by what
/// your own participants take.
TrialDurations assumed_durations();

struct ExpectedLength {
  double trials = 0;   ///< with catch trials
  double minutes = 0;  ///< with demonstrations, least breaks and the gaps between trials
  int staircases = 0;
  double staircase_trials = 0;  ///< of all staircases together, without catch trials
};

/// Counts trials. A staircase whose length depends on the answers is simulated (up to 1000 trials)
/// with 200 observers whose thresholds lie evenly between a quarter of the largest level that is
/// planned at its reference (an adaptive one's start) and all of it; an
/// observer perceives a difference of 1.4 times its threshold in 84 % of trials. The same protocol
/// always gives the same forecast.
ExpectedLength expected_length(const Protocol& protocol,
                               const TrialDurations& durations = assumed_durations());

}  // namespace heft
