// The paper's hypotheses, each with the figures of a log that speak to it. No verdicts: what the
// figures mean is the reader's to say.
#pragma once

#include <vector>

#include "analysis/Summary.h"

namespace heft {

/// E1-H1...E1-H3 (sorting) and E2-H1, E2-H2 (JND), stated as in the paper.
std::vector<Hypothesis> hypotheses_of(const Summary& summary);

}  // namespace heft
