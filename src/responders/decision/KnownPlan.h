// Null models whose answers follow from the plan of a trial, whatever is displayed. They show which
// answers are possible without perceiving anything, and are not models of people.
#pragma once

#include <span>

#include "base/Random.h"
#include "responders/Responder.h"
#include "responders/ResponderParameters.h"

namespace heft {

struct SessionPlan;

/// A comparison's start is the largest level that its procedure plans before the first response; a
/// catch trial has that of its reference. None for other tasks and procedures without such levels.
TrialTruth truth_of(const SessionPlan& session, const TrialPlan& plan);

/// "Different" where level / start + anchor_noise N(0, 1) > anchor_fraction, then either cube: the
/// answers follow the staircase and no mass. In trials without a start "different" with
/// probability p.
Answer start_anchored_answer(const ResponderParameters& parameters, const TrialView& trial,
                             std::span<const int> wrong_slots, RandomStream& stream);

/// Each mass m is judged as m exp(weber_noise N(0, 1)); "different" where the largest judged mass
/// is more than 1 + weber_fraction times the smallest. Equal in every technique.
Answer weber_answer(const ResponderParameters& parameters, const TrialView& trial,
                    std::span<const int> wrong_slots, RandomStream& stream);

}  // namespace heft
