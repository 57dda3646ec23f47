// Error against CPU time: a line for each simulator, a point for each rate; median and worst scene.
#include <algorithm>
#include <cmath>
#include <map>

#include "analysis/charts/Plot.h"
#include "base/math/Quantiles.h"
#include "results/physics/PhysicsStudy.h"
#include "results/physics/scenes/Measurements.h"

namespace heft {

namespace {
constexpr double blown_up_mm = 1000, smallest_mm = 1e-5;

struct Point {
  int rate_hz = 0;
  double cpu_us_per_s = 0, median_mm = 0, worst_mm = 0;
};

// The error, where instability is drawn on a separate line far above all errors.
double error_mm(const Measurement& one) {
  if (one.outcome == RunOutcome::blew_up) return blown_up_mm;
  return std::max(one.error.clone_rms_mm, smallest_mm);
}

using Lines = std::map<std::string, std::vector<Point>>;

// Scenes with contact and a unique solution, in the paper's range of stiffness.
bool is_counted(const Measurement& one) {
  const Coupling& coupling = one.scene.scene.coupling;
  return one.outcome != RunOutcome::outside_model && one.scene.unique_if_rigid() &&
         coupling.decoupled && one.scene.kind != SceneClass::free_air &&
         coupling.stiffness_n_per_m == 50;
}

Lines lines_of(std::span<const Measurement> measurements) {
  std::map<std::string, std::map<int, std::vector<const Measurement*>>> groups;
  for (const Measurement& one : measurements)
    if (is_counted(one)) groups[one.simulator][one.rate_hz].push_back(&one);
  Lines lines;
  for (const auto& [simulator, rates] : groups) {
    for (const auto& [rate_hz, ones] : rates) {
      std::vector<double> errors_mm, cpu_us;
      for (const Measurement* one : ones) {
        errors_mm.push_back(error_mm(*one));
        cpu_us.push_back(one->cpu_us_per_s);
      }
      lines[simulator].push_back({rate_hz, *quantile(cpu_us, 0.5), *quantile(errors_mm, 0.5),
                                  std::ranges::max(errors_mm)});
    }
  }
  return lines;
}

// Rates that are labeled: along the lines of comparison, and at the ends of the others if stable.
bool tells_rate(const std::string& simulator, const Point& point,
                const std::vector<Point>& points) {
  if (point.median_mm >= blown_up_mm) return false;
  const bool is_end = &point == &points.front() || &point == &points.back();
  return simulator == "boxes" || simulator == "push" || is_end;
}

std::string data_of(const Lines& lines) {
  std::string script;
  std::size_t i = 0;
  for (const auto& [simulator, points] : lines) {
    script += fmt::format("$line{} << END\n", i++);
    for (const Point& point : points)
      script += fmt::format(
          "{} {} {} {}\n", point.cpu_us_per_s, point.median_mm, point.worst_mm,
          tells_rate(simulator, point, points) ? std::to_string(point.rate_hz) : "\"\"");
    script += "END\n";
  }
  return script;
}

// Labels at the expensive ends of the lines, moved apart where they would overlap.
std::string labels_of(const Lines& lines, double Point::*error) {
  struct Label {
    double x, y;
    std::string name;
    bool on_top;  // on the line of unstable runs
  };
  std::vector<Label> labels;
  for (const auto& [simulator, points] : lines)
    labels.push_back({points.back().cpu_us_per_s, std::log10(points.back().*error), simulator,
                      points.back().*error >= blown_up_mm});
  std::ranges::sort(labels, {}, &Label::y);
  std::string script = "set label 'blows up' at 0.7, 1400 font ',10' textcolor '#c00000'\n";
  double last_y = -99;
  for (const Label& label : labels) {
    const double y = std::max(label.y, last_y + 0.28);
    last_y = y;
    script += fmt::format("set label {} at {}, {} left offset 0.9,{} font ',11' textcolor '{}'\n",
                          gnuplot_quoted(label.name), label.x, std::pow(10, y),
                          label.on_top ? 0.5 : 0, color_of(label.name));
  }
  return script;
}

std::string panel(const Lines& lines, double Point::*error, int column, const char* title) {
  std::string script = labels_of(lines, error);
  script += fmt::format("set title {} font ',13'\nplot ", gnuplot_quoted(title));
  std::size_t i = 0;
  for (const auto& [simulator, points] : lines) {
    const std::string color = color_of(simulator);
    script += fmt::format(
        "$line{0} using 1:{1} with linespoints linewidth 1.6 pointtype 7 pointsize 0.5 linecolor "
        "'{2}' notitle, $line{0} using 1:{1}:4 with labels offset 0,-0.7 font ',7' textcolor "
        "'{2}' notitle, ",
        i++, column, color);
  }
  return script +
         fmt::format(
             "{} with lines dashtype 3 linecolor '#c00000' notitle, 0.1 with lines "
             "dashtype 2 linecolor '#999999' notitle\n",
             blown_up_mm) +
         "unset label\n";  // prevents labels, title and caption in the next panel
}
}  // namespace

void draw_work_precision(const StudyOptions& options, std::span<const Measurement> measurements) {
  const Lines lines = lines_of(measurements);
  const std::string caption =
      "Clone's center against the reference, RMS over time; scenes with contact that have one "
      "answer for rigid bodies, with the paper's spring. Small numbers: steps a second, "
      "from point to point twice as many. Points on "
      "the red dotted line blew up. Dashed gray: 0.1 mm, what a session tolerates. push and "
      "quasi_static: straight pushes of one cube alone. " +
      provenance(options);
  const std::string script =
      gnuplot_header({"work_precision.svg", 1240, 660,
                      "What accuracy costs: error against computing time", caption}) +
      data_of(lines) +
      fmt::format(
          "set logscale xy\nset format y '%g'\nset format x '%g'\nset yrange [{}:{}]\n"
          "set xrange [0.5:3e5]\n"
          "set xlabel 'CPU time per simulated second (\u00b5s, one core)'\n"
          "set ylabel 'error of the clone (mm RMS)'\n"
          "set multiplot layout 1,2 margins screen 0.085, screen 0.985, screen caption_top + "
          "70*pixel, screen 1-88*pixel spacing screen 0.09\n",
          smallest_mm, 5 * blown_up_mm) +
      panel(lines, &Point::median_mm, 2, "the median scene") +
      panel(lines, &Point::worst_mm, 3, "the worst scene") + "unset multiplot\n";
  draw(options, "work_precision", script);
}

}  // namespace heft
