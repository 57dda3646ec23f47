// The paper's hypotheses, and what these data say of them.
#pragma once

#include <vector>

#include "analysis/dataset/Summary.h"

namespace heft {

/// E1-H1...E1-H3 (sorting) and E2-H1, E2-H2 (JND), stated as in the paper.
/// Each is declared or exploratory, as the summary's plan says.
std::vector<Hypothesis> hypotheses_of(const Summary& summary);

}  // namespace heft
