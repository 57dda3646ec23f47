// How far the clone stays behind the effector for cubes of all masses: what people perceive.
#pragma once

#include "bench/StudyFiles.h"

namespace heft {

/// lag_vs_mass.csv and lag_vs_mass.svg
void study_lag(const StudyOptions& options);

}  // namespace heft
