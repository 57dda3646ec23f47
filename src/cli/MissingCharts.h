// What is said when a report has no charts because gnuplot is not installed.
#pragma once

#include <string>

#include "analysis/Report.h"

namespace heft::cli {

/// Says how to get the charts of a report in `folder`, if they were not drawn.
void explain_missing_charts(const ReportResult& report, const std::string& folder);

}  // namespace heft::cli
