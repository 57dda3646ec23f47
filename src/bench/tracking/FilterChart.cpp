// filters.svg: lag to the right, jitter upwards.
#include <array>
#include <map>

#include "analysis/Gnuplot.h"
#include "bench/tracking/Filters.h"

namespace heft {

namespace {
constexpr int width_px = 900, height_px = 560;
const std::map<std::string, std::string_view> colors{{"none", "#555555"},
                                                     {"heft", "#1f5fa8"},
                                                     {"exponential", "#b8860b"},
                                                     {"One-Euro", "#c0561f"},
                                                     {"Kalman", "#3c8d5a"}};
}  // namespace

std::string filter_chart(const std::vector<FilterResult>& results, const StudyOptions& options) {
  const std::string caption = fmt::format(
      "Poses that our tracker measured at 30 pictures a second and 640x480 pixels, then filtered. "
      "Jitter: RMS distance of the effector's tip from its mean while it is held still. Lag: the "
      "delay that explains strokes of 0.4 m/s best. Over video, lag pulls the clone off the filmed "
      "effector and feels like mass. {}",
      provenance(options));
  std::string script = gnuplot_header(
      {"filters.svg", width_px, height_px, "What filters take away and what they cost", caption});
  std::string plots;
  for (const auto& [family, color] : colors) {
    std::string block;
    for (const FilterResult& result : results)
      if (result.family == family)
        block += fmt::format("{} {} \"{}\"\n", result.lag_ms, result.jitter_mm, result.name());
    const std::string name = family == "One-Euro" ? "one_euro" : family;
    script += fmt::format("${} << END\n{}END\n", name, block);
    plots += fmt::format(
        "{}${} using 1:2 with linespoints pointtype 7 pointsize {} linewidth 1 linecolor '{}' "
        "notitle, ${} using 1:2:3 with labels {} font ',11' textcolor '{}' "
        "notitle",
        plots.empty() ? "" : ", \\\n", name, family == "heft" ? 1.6 : 1.0, color, name,
        family == "none" ? "right offset -1.2,0" : "left offset 1.2,0.3", color);
  }
  script +=
      "set tmargin at screen 1-50*pixel\nset bmargin at screen caption_top + 76*pixel\n"
      "set lmargin 11\nset rmargin 24\nset xrange [-12:*]\nset yrange [0:*]\nset grid xtics\n"
      "set xlabel 'lag while moving (ms)'\nset ylabel 'jitter at rest (mm, RMS)'\n";
  return script + "plot " + plots + '\n';
}

}  // namespace heft
