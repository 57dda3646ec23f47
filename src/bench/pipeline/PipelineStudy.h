// heft bench pipeline: what each stage from a camera's picture to the shown one costs, and whether
// memory stays flat over an hour.
#pragma once

#include "bench/Study.h"

namespace heft {

void run_pipeline_study(const StudyOptions& options);

}  // namespace heft
