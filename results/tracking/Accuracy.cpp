#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/charts/Plot.h"
#include "results/tracking/TrackingStudy.h"
#include "results/tracking/comparison/ComparisonTracker.h"

namespace heft {

namespace {
struct Series {
  std::string_view label, color;
  std::string_view detector, refinement;
  bool region_of_interest;
  bool numbers_above;  ///< decimations stand over the points, or under them
};
constexpr std::array series{
    Series{"heft", "#1f5fa8", "heft", "cells + bias removed", true, true},
    Series{"heft, edge bias left in", "#3c8d5a", "heft", "cells", true, false},
    Series{"heft, borders of tags alone", "#4fa3c7", "heft", "edges + bias removed", true, false},
    Series{"heft on AprilTag's corners", "#7a5aa6", "heft", "corners + bias removed", true, true},
    Series{"heft on AprilTag's corners, bias left in", "#8a94a0", "heft", "corners", true, false},
    Series{"AprilTag + solvePnP", "#c0561f", "apriltag + solvePnP", "corners", false, true},
    Series{"AprilTag, largest tag's IPPE", "#b8860b", "apriltag + IPPE", "corners", false, false},
    Series{"aruco + solvePnP", "#b03a6f", "aruco + solvePnP", "corners", false, true},
    Series{"aruco (AprilTag corners) + solvePnP", "#5d4037", "aruco(apriltag) + solvePnP",
           "corners", false, true}};
constexpr int chart_width_px = 1180, chart_height_px = 680;

bool is_of(const MethodName& name, const Series& one) {
  return name.detector == one.detector && name.refinement == one.refinement &&
         name.region_of_interest == one.region_of_interest;
}

// Decimation, time, median and p95 of the tip, share found.
std::string block_of(const std::vector<MethodResult>& results, int picture_px, const Series& one,
                     std::size_t index) {
  std::string block;
  for (const auto& [px, name, s] : results)
    if (px == picture_px && is_of(name, one) && s.tip_mm.p95)
      block += fmt::format("{:g} {} {} {} {}\n", name.decimate, or_nan(s.time_ms.median),
                           *s.tip_mm.median, *s.tip_mm.p95, s.effector_found);
  return block.empty() ? "" : fmt::format("$s{}_{} << END\n{}END\n", picture_px, index, block);
}

// Lines through p95; open points where the effector was found in less than nine of ten pictures.
std::string plot_of(int picture_px, const Series& one, std::size_t index, bool with_title) {
  const std::string name = fmt::format("$s{}_{}", picture_px, index);
  return fmt::format(
      "{0} using 2:4 with lines linewidth 2 linecolor '{1}' {2}, "
      "{0} using 2:($5>=0.9 ? $4 : NaN) with points pointtype 7 pointsize 1 linecolor '{1}' "
      "notitle, "
      "{0} using 2:($5<0.9 ? $4 : NaN) with points pointtype 6 pointsize 1 linecolor '{1}' "
      "notitle, "
      "{0} using 2:4:(sprintf('%g', $1)) with labels offset 0,0.7 font ',9' textcolor '{1}' "
      "notitle",
      name, one.color, with_title ? "title " + gnuplot_quoted(one.label) : std::string("notitle"));
}

bool is_anywhere(const std::vector<MethodResult>& results, const Series& one) {
  return std::ranges::any_of(results, [&](const MethodResult& result) {
    return is_of(result.name, one) && result.summary.tip_mm.p95;
  });
}

// For the legend of both panels, where only the other one has points.
std::string only_title(const Series& one) {
  return fmt::format("NaN with lines linewidth 2 linecolor '{}' title {}", one.color,
                     gnuplot_quoted(one.label));
}

std::string panel(const std::vector<MethodResult>& results, int picture_px, double left,
                  double right, bool with_titles) {
  std::string blocks, plots;
  for (std::size_t i = 0; i < series.size(); ++i) {
    const std::string block = block_of(results, picture_px, series[i], i);
    blocks += block;
    const std::string plot = !block.empty() ? plot_of(picture_px, series[i], i, with_titles)
                             : with_titles && is_anywhere(results, series[i])
                                 ? only_title(series[i])
                                 : std::string();
    if (!plot.empty()) plots += (plots.empty() ? "" : ", \\\n") + plot;
  }
  if (plots.empty()) return "";
  return fmt::format(
      "{}set lmargin at screen {}\nset rmargin at screen {}\nset title '{} pixels' offset 0,-0.6\n"
      "plot {}\nunset label\nunset ylabel\n",
      blocks, left, right, size_name(picture_px), plots);
}

std::string accuracy_chart(const std::vector<MethodResult>& results, const StudyOptions& options) {
  const std::string caption = fmt::format(
      "Strokes of a hand-held effector over the printed board, filmed by the synthetic camera "
      "(noise SD 3 of 255, 4 ms exposure, true lens and geometry); numbers at the points: the "
      "picture is searched smaller by that factor. Error: distance of the effector's tip in the "
      "board's frame from the truth, 95th percentile of the pictures in which it was found. Time: "
      "median of one thread's processor time, all methods in turn on each picture.{} {}",
      has_aruco() ? ""
                  : " OpenCV's aruco module was not there when this was built, so it is missing.",
      provenance(options));
  std::string script =
      gnuplot_header({"accuracy.svg", chart_width_px, chart_height_px,
                      "How far off the effector's tip is, and what it costs", caption});
  script +=
      "set label 'lower left is better; open points: found in less than 9 of 10 pictures' at "
      "screen "
      "0.5, screen 1-46*pixel center font ',11' textcolor '#555555'\n"
      "set multiplot\nset tmargin at screen 1-90*pixel\n"
      "set bmargin at screen caption_top + 150*pixel\n"
      "set logscale xy\nset grid xtics\nset xrange [1:200]\nset yrange [0.05:200]\n"
      "set xtics (1,2,5,10,20,50,100,200)\nset ytics (0.05,0.1,0.2,0.5,1,2,5,10,20,50,100)\n"
      "set xlabel 'processor time per picture (ms)'\n"
      "set ylabel 'error of the tip, 95 % of pictures below (mm)' offset 1.5,0\n"
      "set key at screen 0.5, caption_top + 40*pixel center maxrows 3 width 1 font ',11' samplen "
      "2\n";
  script += panel(results, 640, 0.07, 0.5, true) + panel(results, 1280, 0.55, 0.98, false);
  return script + "unset multiplot\n";
}

constexpr std::string_view columns =
    "picture,detector,refinement,decimate,region_of_interest,pictures,board_found,effector_found,"
    "board_median_mm,board_p95_mm,board_median_deg,board_p95_deg,tip_median_mm,tip_p95_mm,"
    "effector_median_deg,effector_p95_deg,time_median_ms,time_p95_ms";

FilmPlan plan_for(int width_px, bool quick) {
  FilmPlan plan;
  plan.width_px = width_px;
  plan.n_takes = quick ? 2 : width_px == 640 ? 24 : 20;
  plan.n_pictures = quick ? 4 : 6;
  return plan;
}

void write(const std::vector<MethodResult>& results, const StudyOptions& options) {
  CsvFile csv(options, "accuracy.csv", columns);
  for (const auto& [width_px, name, s] : results)
    csv.row(size_name(width_px), name.detector, name.refinement, name.decimate,
            name.region_of_interest ? "yes" : "no", s.n, s.board_found, s.effector_found,
            or_nan(s.board_mm.median), or_nan(s.board_mm.p95), or_nan(s.board_deg.median),
            or_nan(s.board_deg.p95), or_nan(s.tip_mm.median), or_nan(s.tip_mm.p95),
            or_nan(s.effector_deg.median), or_nan(s.effector_deg.p95), or_nan(s.time_ms.median),
            or_nan(s.time_ms.p95));
}
}  // namespace

std::vector<MethodResult> study_accuracy(const StudyOptions& options, StudyProgress& progress) {
  std::vector<MethodResult> results;
  for (const int width_px : picture_widths_px) {
    progress.next("every method at " + size_name(width_px));
    const auto methods = all_methods(width_px, options.quick);
    const auto films = film(plan_for(width_px, options.quick), methods);
    for (std::size_t m = 0; m < methods.size(); ++m)
      results.push_back({width_px, methods[m], summary_of(films[m].errors())});
  }
  write(results, options);
  draw(options, "accuracy", accuracy_chart(results, options));
  return results;
}

}  // namespace heft
