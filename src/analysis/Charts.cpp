#include "analysis/Charts.h"

#include <fmt/format.h>

namespace heft {

std::string caption_of(const Summary& summary) {
  return fmt::format("Made by: {} (heft {})", summary.command, HEFT_VERSION);
}

std::vector<Chart> charts_of(const Summary& summary) {
  std::vector<Chart> charts{participant_flow_chart(summary), sorting_chart(summary),
                            choice_chart(summary), jnd_chart(summary), tracks_chart(summary)};
  for (Chart& chart : multiples_charts(summary)) charts.push_back(std::move(chart));
  for (Chart& chart : person_charts(summary)) charts.push_back(std::move(chart));
  for (Chart& chart : people_charts(summary)) charts.push_back(std::move(chart));
  std::erase_if(charts, [](const Chart& chart) { return chart.script.empty(); });
  return charts;
}

}  // namespace heft
