#include "analysis/Charts.h"

#include <fmt/format.h>

#include "analysis/Gnuplot.h"

namespace heft {

std::string caption_of(const Summary& summary) {
  return fmt::format("Made by: {} (heft {})", summary.command, HEFT_VERSION);
}

std::string framed(const Chart& chart, const Summary& summary, int height_px,
                   std::string_view axes) {
  return gnuplot_header({chart.name + ".svg", 720, height_px, chart.title, caption_of(summary)}) +
         fmt::format(
             "set key at screen 0.5, screen 1-40*pixel center top horizontal\n"
             "set tmargin at screen 1-86*pixel\nset bmargin at screen caption_top + 66*pixel\n{}",
             axes);
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
