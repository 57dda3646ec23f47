// limits.svg: for each limit the share of pictures in which the effector was found, and under it
// the error where it was.
#include <algorithm>

#include "analysis/Gnuplot.h"
#include "bench/tracking/Limits.h"

namespace heft {

namespace {
constexpr int width_px = 1000, height_px = 1230;
constexpr int n_columns = 3;
constexpr std::string_view our_color = "#1f5fa8", plain_color = "#c0561f";

// Value, found and p95 of ours, found and p95 of the plain chain; NaN where there is none.
std::string block_of(const std::string& name, const std::vector<LimitPoint>& points) {
  std::string block = fmt::format("${} << END\n", name);
  for (const LimitPoint& point : points)
    if (point.limit == name)
      block += fmt::format("{} {} {} {} {}\n", point.value, 100 * point.ours.effector_found,
                           or_nan(point.ours.tip_p95_mm), 100 * point.plain.effector_found,
                           or_nan(point.plain.tip_p95_mm));
  return block + "END\n";
}

std::string two_lines(const std::string& name, int our_column, int plain_column, bool titles) {
  const auto line = [&](int column, std::string_view color, std::string_view title) {
    return fmt::format(
        "${} using 1:{} with linespoints linewidth 2 pointtype 7 pointsize 0.7 linecolor '{}' {}",
        name, column, color, titles ? "title " + gnuplot_quoted(title) : std::string("notitle"));
  };
  return line(plain_column, plain_color, "AprilTag + solvePnP") + ", " +
         line(our_column, our_color, "heft");
}

// A strip of a panel, pixels from the top.
std::string place(int column, int top_px, int bottom_px) {
  const double left = 0.085 + 0.311 * column;
  return fmt::format(
      "set lmargin at screen {:.4f}\nset rmargin at screen {:.4f}\n"
      "set tmargin at screen 1-{}*pixel\nset bmargin at screen 1-{}*pixel\n",
      left, left + 0.25, top_px, bottom_px);
}

std::string panel(const Limit& limit, std::size_t index, const std::vector<LimitPoint>& points) {
  const int column = static_cast<int>(index) % n_columns;
  const int top_px = 100 + 350 * (static_cast<int>(index) / n_columns);
  const auto [low, high] = std::ranges::minmax(limit.values);
  std::string script = block_of(limit.name, points);
  script += fmt::format("{}\nset xrange [{}:{}]\n",
                        limit.logarithmic ? "set logscale x" : "unset logscale x", low, high);
  script += place(column, top_px, top_px + 70);
  script += fmt::format(
      "set format x ''\nunset xlabel\nunset logscale y\nset yrange [0:105]\nset ytics 0,50,100\n"
      "set ylabel {} offset 1,0\n{}\nplot {}\nunset label\nunset key\n",
      gnuplot_quoted(column == 0 ? "found (%)" : ""),
      index == 0 ? "set key at screen 0.5, screen 1-66*pixel center maxrows 1 font ',12'" : "",
      two_lines(limit.name, 2, 4, index == 0));
  script += place(column, top_px + 85, top_px + 270);
  return script +
         fmt::format(
             "set format x '%g'\nset xlabel {} font ',11' offset 0,0.4\nset logscale y\n"
             "set yrange [0.03:300]\nset ytics (0.1,1,10,100)\nset ylabel {} offset 1,0\nplot {}\n",
             gnuplot_quoted(limit.label), gnuplot_quoted(column == 0 ? "tip error, p95 (mm)" : ""),
             two_lines(limit.name, 3, 5, false));
}
}  // namespace

std::string limits_chart(const std::vector<LimitPoint>& points, const StudyOptions& options) {
  const std::string caption = fmt::format(
      "One thing made worse at a time, everything else as usual: 640x480 pixels, 32 mm tags (38 "
      "pixels), camera at 0.45 m, noise SD 3, 4 ms exposure, effector held in a hand, no motion "
      "but under \"motion\". {} pictures a point, each tracked on its own, without an earlier one "
      "to go on. Above: in how many the effector was found. Below: error of its tip where it was. "
      "AprilTag searches a picture 1.5 times smaller here, heft the whole one. {}",
      points.empty() ? 0 : points.front().ours.n, provenance(options));
  std::string script =
      gnuplot_header({"limits.svg", width_px, height_px, "Where tracking ends", caption});
  script += "set multiplot\nset tics font ',11'\n";
  const std::vector<Limit> all = limits();
  for (std::size_t i = 0; i < all.size(); ++i) script += panel(all[i], i, points);
  return script + "unset multiplot\n";
}

}  // namespace heft
