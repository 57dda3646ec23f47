// The introduction: who found the heavier cube on the first try.
#pragma once

#include <optional>
#include <span>

#include "analysis/Dataset.h"
#include "analysis/Proportion.h"

namespace heft {

struct IntroductionSummary {
  Rate first_try;  ///< of participants: exactly one `select`
  std::optional<double> published_percent;
  std::optional<int> published_n;  ///< participants
};

/// Each participant's first completed introduction; nobody is untrained twice. Sessions in order.
IntroductionSummary introduction_of(std::span<const SessionData> sessions);

}  // namespace heft
