#include <algorithm>

#include "analysis/charts/Plot.h"
#include "results/tracking/TrackingStudy.h"

namespace heft {

namespace {
constexpr int chart_width_px = 1000, chart_height_px = 1230;
constexpr int n_columns = 3;
constexpr std::string_view our_color = "#1f5fa8", plain_color = "#c0561f";

// Value, found and p95 of ours, found and p95 of the plain chain; NaN where there is none.
std::string block_of(const std::string& name, const std::vector<LimitPoint>& points) {
  std::string block = fmt::format("${} << END\n", name);
  for (const LimitPoint& point : points)
    if (point.limit == name)
      block += fmt::format("{} {} {} {} {}\n", point.value, 100 * point.ours.effector_found,
                           or_nan(point.ours.tip_mm.p95), 100 * point.plain.effector_found,
                           or_nan(point.plain.tip_mm.p95));
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
  return gnuplot_place(left, left + 0.25, top_px, bottom_px);
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

std::string limits_chart(const std::vector<LimitPoint>& points, const StudyOptions& options) {
  const std::string caption = fmt::format(
      "One thing made worse at a time, everything else as usual: 640x480 pixels, 32 mm tags (38 "
      "pixels), camera at 0.45 m, noise SD 3, 4 ms exposure, effector held in a hand, no motion "
      "but under \"motion\". {} pictures a point, each tracked on its own, without an earlier one "
      "to go on. Above: in how many the effector was found. Below: error of its tip where it was. "
      "AprilTag searches a picture 1.5 times smaller here, heft the whole one. {}",
      points.empty() ? 0 : points.front().ours.n, provenance(options));
  std::string script = gnuplot_header(
      {"limits.svg", chart_width_px, chart_height_px, "Where tracking ends", caption});
  script += "set multiplot\nset tics font ',11'\n";
  const std::vector<Limit> all = limits();
  for (std::size_t i = 0; i < all.size(); ++i) script += panel(all[i], i, points);
  return script + "unset multiplot\n";
}

constexpr int width_px = 640;
constexpr std::uint64_t seed = 4;

MethodName bias_left_in() {
  MethodName name = our_method(width_px);
  name.refinement = "cells";
  return name;
}

// A picture on its own: what came before is forgotten.
TrackedError one_error(const TrackingMethod& method, const LimitScene& scene,
                       const Image& picture) {
  method.reset();
  return error_of(method.track(picture, 0), scene.settings.camera_from_board,
                  scene.take.at(scene.t_s), tip_of(scene.apparatus.effector));
}

// What each limit is tried with.
std::array<MethodName, 3> compared() {
  return {our_method(width_px), bias_left_in(), plain_method(width_px)};
}

LimitPoint at_value(const Limit& limit, double value, int n_pictures) {
  const LimitScene first = limit.scene(value, 0);  // they differ in their takes alone
  SyntheticCamera camera(first.apparatus, first.settings, seed);
  std::vector<TrackingMethod> methods;
  for (const MethodName& name : compared()) methods.push_back(make_method(name, first.apparatus));
  std::array<std::vector<TrackedError>, 3> errors;
  for (int i = 0; i < n_pictures; ++i) {
    const auto number = static_cast<std::uint64_t>(i);
    const LimitScene scene = limit.scene(value, number);
    const Image picture =
        camera.picture([&](double t_s) { return scene.take.at(t_s); }, scene.t_s, number);
    for (std::size_t m = 0; m < methods.size(); ++m)
      errors[m].push_back(one_error(methods[m], scene, picture));
  }
  return {limit.name, value, summary_of(errors[0]), summary_of(errors[1]), summary_of(errors[2])};
}

void write(const std::vector<LimitPoint>& points, const StudyOptions& options) {
  CsvFile csv(options, "limits.csv",
              "limit,value,method,refinement,pictures,board_found,effector_found,board_p95_mm,tip_"
              "median_mm,tip_p95_mm,effector_p95_deg");
  for (const LimitPoint& point : points) {
    const std::array summaries{&point.ours, &point.bias_left_in, &point.plain};
    for (std::size_t m = 0; m < summaries.size(); ++m) {
      const MethodName name = compared()[m];
      const ErrorSummary& s = *summaries[m];
      csv.row(point.limit, point.value, name.detector, name.refinement, s.n, s.board_found,
              s.effector_found, or_nan(s.board_mm.p95), or_nan(s.tip_mm.median),
              or_nan(s.tip_mm.p95), or_nan(s.effector_deg.p95));
    }
  }
}
}  // namespace

std::vector<LimitPoint> study_limits(const StudyOptions& options, StudyProgress& progress) {
  std::vector<LimitPoint> points;
  for (const Limit& limit : limits()) {
    progress.next("limits: " + limit.name);
    const auto n_values = options.quick ? 2 : limit.values.size();
    for (std::size_t i = 0; i < n_values; ++i)
      points.push_back(at_value(limit, limit.values[i], options.quick ? 1 : 32));
  }
  write(points, options);
  draw(options, "limits", limits_chart(points, options));
  return points;
}

}  // namespace heft
