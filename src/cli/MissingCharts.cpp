#include "cli/MissingCharts.h"

#include "cli/Talk.h"

namespace heft::cli {

void explain_missing_charts(const ReportResult& report, const std::string& folder) {
  if (report.charts_drawn) return;
  say("No charts: gnuplot is not installed (sudo apt-get install gnuplot-nox). The .gp files in {} "
      "draw them later: gnuplot NAME.gp\n",
      folder);
}

}  // namespace heft::cli
