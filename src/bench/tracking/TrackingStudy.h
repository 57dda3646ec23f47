// heft bench tracking: how well and how fast poses are found, where that ends, and what filters do
// to them. Everything is filmed by the synthetic camera, so the truth is known.
#pragma once

#include "bench/Study.h"

namespace heft {

void run_tracking_study(const StudyOptions& options);

}  // namespace heft
