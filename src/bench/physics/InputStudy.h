// What the way from camera poses to a target costs, against a hand that is known at all times.
#pragma once

#include "bench/StudyFiles.h"

namespace heft {

/// input.csv and input.svg
void study_input(const StudyOptions& options);

}  // namespace heft
