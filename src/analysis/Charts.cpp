#include "analysis/Charts.h"

#include <fmt/format.h>

namespace heft {

std::string caption_of(const Summary& summary) {
  return fmt::format("Made by: {} (heft {})", summary.command, HEFT_VERSION);
}

std::vector<Chart> charts_of(const Summary& summary) {
  std::vector<Chart> charts{sorting_chart(summary), jnd_chart(summary), tracks_chart(summary)};
  std::erase_if(charts, [](const Chart& chart) { return chart.script.empty(); });
  return charts;
}

}  // namespace heft
