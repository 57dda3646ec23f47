// `heft bench physics`: what the simulators cost, how far off they are, and where they fail.
#pragma once

#include "bench/Study.h"

namespace heft {

void run_physics_study(const StudyOptions& options);

}  // namespace heft
