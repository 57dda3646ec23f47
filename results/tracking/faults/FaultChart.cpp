#include <algorithm>
#include <array>

#include "analysis/charts/Plot.h"
#include "results/tracking/faults/FaultStudy.h"

namespace heft {

namespace {
constexpr int chart_width_px = 1180, chart_height_px = 2260;
constexpr int n_columns = 4;

struct Line {
  std::string_view title, color;
  int width_px;
  bool ours;
};
constexpr std::array lines{Line{"heft, 640x480", "#1f5fa8", 640, true},
                           Line{"heft, 1280x720", "#3c8d5a", 1280, true},
                           Line{"AprilTag + solvePnP, 640x480", "#c0561f", 640, false},
                           Line{"AprilTag + solvePnP, 1280x720", "#b8860b", 1280, false}};

// Value, found, median quality, p95.
std::string block_of(const Fault& fault, const Line& line, std::size_t index,
                     const std::vector<FaultPoint>& points) {
  std::string block = fmt::format("${}_{} << END\n", fault.name, index);
  for (const FaultPoint& point : points) {
    if (point.fault != fault.name || point.width_px != line.width_px) continue;
    const ErrorSummary& s = line.ours ? point.ours : point.plain;
    block += fmt::format("{} {} {} {}\n", point.value, 100 * s.effector_found,
                         100 * or_nan(s.quality.median), or_nan(s.tip_mm.p95));
  }
  return block + "END\n";
}

std::string plots(const Fault& fault, int column, bool with_titles) {
  std::string text;
  for (std::size_t i = 0; i < lines.size(); ++i)
    text += fmt::format(
        "{}${}_{} using 1:{} with linespoints linewidth 2 pointtype 7 pointsize 0.6 linecolor "
        "'{}' {}",
        i > 0 ? ", " : "", fault.name, i, column, lines[i].color,
        with_titles ? "title " + gnuplot_quoted(lines[i].title) : std::string("notitle"));
  return text;
}

std::string qualities(const Fault& fault) {
  std::string text;
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (lines[i].ours)
      text += fmt::format(
          ", ${}_{} using 1:3 with lines linewidth 1.5 dashtype 3 linecolor '{}' "
          "notitle",
          fault.name, i, lines[i].color);
  return text;
}

std::string place(int column, int top_px, int bottom_px) {
  const double left = 0.072 + 0.238 * column;
  return gnuplot_place(left, left + 0.19, top_px, bottom_px);
}

std::string panel(const Fault& fault, std::size_t index, const std::vector<FaultPoint>& points) {
  const int column = static_cast<int>(index) % n_columns;
  const int top_px = 120 + 340 * (static_cast<int>(index) / n_columns);
  const auto [low, high] = std::ranges::minmax(fault.values);
  std::string script;
  for (std::size_t i = 0; i < lines.size(); ++i) script += block_of(fault, lines[i], i, points);
  script += fmt::format("set xrange [{}:{}]\n", low, high) + place(column, top_px, top_px + 80);
  script += fmt::format(
      "set format x ''\nunset xlabel\nunset logscale y\nset yrange [0:105]\nset ytics 0,50,100\n"
      "set ylabel {} offset 2,0 font ',10'\n{}\nplot {}{}\nunset label\nunset key\n",
      gnuplot_quoted(column == 0 ? "found, quality (%)" : ""),
      index == 0 ? "set key at screen 0.5, screen 1-66*pixel center maxrows 2 font ',11'" : "",
      plots(fault, 2, index == 0), qualities(fault));
  script += place(column, top_px + 92, top_px + 265);
  return script + fmt::format(
                      "set format x '%g'\nset xlabel {} font ',10' offset 0,0.4\nset logscale y\n"
                      "set yrange [0.005:100]\nset ytics (0.01,0.1,1,10,100)\nset ylabel {} offset "
                      "2,0 font ',10'\n"
                      "plot {}\n",
                      gnuplot_quoted(fault.label),
                      gnuplot_quoted(column == 0 ? "tip error, p95 (mm)" : ""),
                      plots(fault, 4, false));
}
}  // namespace

void draw_faults(const std::vector<FaultPoint>& points, const StudyOptions& options) {
  const std::string caption = fmt::format(
      "One fault at a time, everything else as usual: camera at 0.45 m, noise SD 3, 4 ms exposure, "
      "effector held in a hand. {} pictures a point at 640x480, {} at 1280x720, each on its own, "
      "after four from which the tone curve is learned; of a moving effector the third and fourth "
      "of a film. Above: in how many the effector was found, and dotted, heft's median quality. "
      "Below: error of the tip where it was, 95th percentile; under a rolling shutter at the time "
      "at which the effector's own row was read, for AprilTag too. Repeated and dropped pictures: "
      "under a rolling shutter of 25 ms. {}",
      points.empty() ? 0 : points.front().ours.n, points.empty() ? 0 : points.back().ours.n,
      provenance(options));
  std::string script =
      gnuplot_header({"faults.svg", chart_width_px, chart_height_px, "What cameras do", caption});
  script += "set multiplot\nset tics font ',10'\n";
  const std::vector<Fault> all = faults();
  for (std::size_t i = 0; i < all.size(); ++i) script += panel(all[i], i, points);
  draw(options, "faults", script + "unset multiplot\n");
}

}  // namespace heft
