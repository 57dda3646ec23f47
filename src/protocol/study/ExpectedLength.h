// How long a session will be: a forecast for planning, not a promise.
#pragma once

#include <map>
#include <string>

#include "protocol/Protocol.h"

namespace heft {

using TrialsByTask = std::map<std::string, double>;

/// With catch trials. A staircase whose length depends on the answers is simulated (up to 1000
/// trials) with 200 observers whose thresholds lie evenly between a quarter of the largest level
/// that is planned at its reference (an adaptive one's start) and all of it; an observer perceives
/// a difference of 1.4 times its threshold in 84 % of trials. The same protocol always gives the
/// same forecast.
TrialsByTask expected_trials(const Protocol& protocol);

double total_of(const TrialsByTask& trials);

/// Whether the number of trials of any block depends on the answers.
bool depends_on_answers(const Protocol& protocol);

/// What these trials take, by TaskDeclaration::trial_s, with demonstrations, least breaks and the
/// gaps between trials.
double expected_minutes(const Protocol& protocol, const TrialsByTask& trials);

}  // namespace heft
