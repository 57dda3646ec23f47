// Expected length of a session, for planning.
#pragma once

#include <map>
#include <string>

#include "protocol/Protocol.h"

namespace heft {

using TrialsByTask = std::map<std::string, double>;

/// With catch trials. A staircase whose length depends on the answers is simulated (up to 1000
/// trials) with 200 observers. Their thresholds are evenly spaced between a quarter of the largest
/// level planned at the reference (an adaptive staircase's start) and that level; an observer
/// perceives a difference of 1.4 times its threshold in 84 % of trials. Equal protocols give equal
/// results.
TrialsByTask expected_trials(const Protocol& protocol);

double total_of(const TrialsByTask& trials);

/// Whether the number of trials in any block depends on the answers.
bool depends_on_answers(const Protocol& protocol);

/// Duration of these trials by TaskDeclaration::trial_s, with demonstrations, minimum breaks and
/// gaps between trials.
double expected_minutes(const Protocol& protocol, const TrialsByTask& trials);

}  // namespace heft
