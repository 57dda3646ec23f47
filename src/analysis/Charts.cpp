#include "analysis/Charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "analysis/Gnuplot.h"

namespace heft {

namespace {
// What a reviewer looks for first comes first: who took part, what the answers are, then each
// staircase and participant, then how it went.
constexpr std::array by_importance{"participant_flow",
                                   "sorting",
                                   "staircases",
                                   "all_staircases",
                                   "choice_curves",
                                   "thresholds_by",
                                   "jnd",
                                   "jnd_against",
                                   "sorting_by",
                                   "labels_by_mass",
                                   "beside_published",
                                   "hits_and_false_alarms",
                                   "lag_by_mass",
                                   "times_by_level",
                                   "times_by_trial",
                                   "tracking_quality"};

std::ptrdiff_t importance(const Chart& chart) {
  std::ptrdiff_t place = 0, longest = 0, found = by_importance.size();
  for (const std::string_view name : by_importance) {
    const auto length = static_cast<std::ptrdiff_t>(name.size());
    if (chart.name.starts_with(name) && length > longest) {
      longest = length;
      found = place;
    }
    place += 1;
  }
  return found;
}
}  // namespace

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
  std::vector<Chart> charts{
      participant_flow_chart(summary), tracks_chart(summary), sorting_chart(summary),
      choice_chart(summary),           jnd_chart(summary),    label_chart(summary),
      published_chart(summary)};
  for (Chart& chart : multiples_charts(summary)) charts.push_back(std::move(chart));
  for (Chart& chart : person_charts(summary)) charts.push_back(std::move(chart));
  for (Chart& chart : people_charts(summary)) charts.push_back(std::move(chart));
  std::erase_if(charts, [](const Chart& chart) { return chart.script.empty(); });
  std::ranges::stable_sort(charts, {}, importance);
  return charts;
}

}  // namespace heft
