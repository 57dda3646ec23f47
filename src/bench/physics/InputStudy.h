// What the way from camera poses to a target costs, against a hand that is known at all times; and
// what condition C1, which should hide masses, gives away where cubes touch cubes.
#pragma once

#include "bench/StudyFiles.h"

namespace heft {

/// input.csv and input.svg
void study_input(const StudyOptions& options);

/// c1_leak.csv and c1_leak.svg
void study_c1_leak(const StudyOptions& options);

}  // namespace heft
