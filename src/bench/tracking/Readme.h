// The page beside the charts: what to choose when, with the figures of this run.
#pragma once

#include <string>
#include <vector>

#include "bench/tracking/Accuracy.h"
#include "bench/tracking/Filters.h"
#include "bench/tracking/Goals.h"
#include "bench/tracking/Limits.h"

namespace heft {

std::string tracking_readme(const std::vector<MethodResult>& accuracy,
                            const std::vector<LimitPoint>& limits,
                            const std::vector<FilterResult>& filters,
                            const std::vector<Goal>& goals, const StudyOptions& options);

}  // namespace heft
