// Error against CPU time: a line for each simulator, a point for each rate; median and worst scene.
// Drawn from work_precision.csv, so that the chart of the checked-in table can be drawn again.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "analysis/charts/Plot.h"
#include "base/Error.h"
#include "base/files/TextFile.h"
#include "base/math/Quantiles.h"
#include "results/physics/PhysicsStudy.h"
#include "results/physics/scenes/Measurements.h"

namespace heft {

namespace {
constexpr double blown_up_mm = 1000, smallest_mm = 1e-5, least_us = 0.5;

struct Point {
  int rate_hz = 0;
  double cpu_us_per_s = 0, median_mm = 0, worst_mm = 0;
};

using Lines = std::map<std::string, std::vector<Point>>;

struct ChartData {
  Lines lines;
  std::string provenance;  // of the table
};

// Scenes with contact and a unique solution, in the paper's range of stiffness.
bool is_counted(const BenchScene& scene) {
  const Coupling& coupling = scene.scene.coupling;
  return scene.unique_if_rigid() && coupling.decoupled && scene.kind != SceneClass::free_air &&
         coupling.stiffness_n_per_m == 50;
}

ChartData read_table(const std::string& csv) {
  const std::string text = read_text_file(csv);
  const auto rows = lines_of(text);
  if (rows.empty()) throw Error(csv + " is empty");
  const auto names = cells_of(rows.front());
  const auto column = [&](std::string_view name) {
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) throw Error(fmt::format("{} has no column {}", csv, name));
    return static_cast<std::size_t>(found - names.begin());
  };
  const std::size_t simulator = column("simulator"), rate = column("rate_hz"),
                    scene = column("scene"), outcome = column("outcome"),
                    error = column("clone_rms_mm"), cpu = column("cpu_us_per_simulated_s"),
                    commit = column("commit"), command = column("command");
  struct Runs {
    std::vector<double> errors_mm, cpu_us;
  };
  std::set<std::string, std::less<>> counted;
  for (const BenchScene& one : bench_scenes())
    if (is_counted(one)) counted.insert(one.name);
  ChartData data;
  std::map<std::string, std::map<int, Runs>> groups;
  for (const std::string_view row : std::span(rows).subspan(1)) {
    const auto cells = cells_of(row);
    if (cells.size() < names.size()) throw Error(csv + " has a row with too few cells");
    data.provenance = provenance(cells[commit], cells[command]);
    if (cells[outcome] == name_of(RunOutcome::outside_model) || !counted.contains(cells[scene]))
      continue;
    Runs& runs = groups[std::string(cells[simulator])][static_cast<int>(*number_in(cells[rate]))];
    // Instability is drawn on a separate line far above all errors.
    runs.errors_mm.push_back(cells[outcome] == name_of(RunOutcome::blew_up)
                                 ? blown_up_mm
                                 : std::max(*number_in(cells[error]), smallest_mm));
    runs.cpu_us.push_back(*number_in(cells[cpu]));
  }
  for (const auto& [name, rates] : groups)
    for (const auto& [rate_hz, runs] : rates)
      data.lines[name].push_back({rate_hz, *quantile(runs.cpu_us, 0.5),
                                  *quantile(runs.errors_mm, 0.5),
                                  std::ranges::max(runs.errors_mm)});
  return data;
}

// Places for the labels of rates beside their points, where they cover neither points nor each
// other. In decades of the axes; a label is about this large in the chart's smallest type.
class FreePlaces {
 public:
  struct Place {
    double x = 0, y = 0;
  };
  void occupy(const Place& point) { taken_.push_back({point, 0.05, 0.08}); }

  std::optional<Place> beside(const Place& point, const std::string& text) {
    constexpr double character = 0.06, line = 0.17, gap = 0.05;
    const double half_width = character * static_cast<double>(text.size()) / 2;
    const double beside = half_width + gap, below = line / 2 + 0.12;
    for (const auto& [dx, dy] : {std::pair(0.0, -below),
                                 {0.0, below},
                                 {beside, -below},
                                 {-beside, -below},
                                 {beside, below},
                                 {-beside, below},
                                 {-beside - gap, 0.0},
                                 {beside + gap, 0.0}}) {
      const Box box{{point.x + dx, point.y + dy}, half_width, line / 2};
      if (std::ranges::any_of(taken_, [&](const Box& other) { return other.overlaps(box); }))
        continue;
      taken_.push_back(box);
      return box.middle;
    }
    return std::nullopt;
  }

 private:
  struct Box {
    Place middle;
    double half_width = 0, half_height = 0;
    bool overlaps(const Box& other) const {
      return std::abs(middle.x - other.middle.x) < half_width + other.half_width &&
             std::abs(middle.y - other.middle.y) < half_height + other.half_height;
    }
  };
  std::vector<Box> taken_;
};

// Labels of the rates: at the ends of stable lines and at 240 Hz, and between them along the lines
// of comparison where there is room.
std::string rates_of(const Lines& lines, double Point::*error) {
  FreePlaces places;
  const auto place_of = [&](const Point& point) {
    return FreePlaces::Place{std::log10(point.cpu_us_per_s), std::log10(point.*error)};
  };
  for (const auto& [simulator, points] : lines)
    for (const Point& point : points) places.occupy(place_of(point));
  std::string script;
  for (const bool between : {false, true})
    for (const auto& [simulator, points] : lines)
      for (const Point& point : points) {
        const bool is_end = &point == &points.front() || &point == &points.back();
        const bool compared = simulator == "boxes" || simulator == "push";
        const bool first = is_end || (compared && point.rate_hz == 240);
        if (point.*error >= blown_up_mm || point.cpu_us_per_s < least_us) continue;
        if (first == between || (between && !compared)) continue;
        const std::string text = fmt::format("{}", point.rate_hz);
        if (const auto place = places.beside(place_of(point), text))
          script +=
              fmt::format("set label '{}' at {}, {} center font ',7' textcolor '{}'\n", text,
                          std::pow(10, place->x), std::pow(10, place->y), color_of(simulator));
      }
  return script;
}

std::string data_of(const Lines& lines) {
  std::string script;
  std::size_t i = 0;
  for (const auto& [simulator, points] : lines) {
    script += fmt::format("$line{} << END\n", i++);
    for (const Point& point : points)
      script += fmt::format("{} {} {}\n", point.cpu_us_per_s, point.median_mm, point.worst_mm);
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
  std::string script = labels_of(lines, error) + rates_of(lines, error);
  script += fmt::format("set title {} font ',13'\nplot ", gnuplot_quoted(title));
  std::size_t i = 0;
  for (const auto& [simulator, points] : lines) {
    const std::string color = color_of(simulator);
    script += fmt::format(
        "$line{} using 1:{} with linespoints linewidth 1.6 pointtype 7 pointsize 0.5 linecolor "
        "'{}' notitle, ",
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

void draw_work_precision(const StudyOptions& options) {
  const auto [lines, from] = read_table(options.out + "/work_precision.csv");
  const std::string caption =
      "Clone's center against the reference, RMS over time; scenes with contact that have one "
      "answer for rigid bodies, with the paper's spring. Small numbers: steps a second, "
      "from point to point twice as many. Points on "
      "the red dotted line blew up. Dashed gray: 0.1 mm, what a session tolerates. push and "
      "quasi_static: straight pushes of one cube alone. " +
      from;
  const std::string script =
      gnuplot_header({"work_precision.svg", 1240, 660,
                      "What accuracy costs: error against computing time", caption}) +
      data_of(lines) +
      fmt::format(
          "set logscale xy\nset format y '%g'\nset format x '%g'\nset yrange [{}:{}]\n"
          "set xrange [{}:3e5]\n"
          "set xlabel 'CPU time per simulated second (\u00b5s, one core)'\n"
          "set ylabel 'error of the clone (mm RMS)'\n"
          "set multiplot layout 1,2 margins screen 0.085, screen 0.985, screen caption_top + "
          "70*pixel, screen 1-88*pixel spacing screen 0.09\n",
          smallest_mm, 5 * blown_up_mm, least_us) +
      panel(lines, &Point::median_mm, 2, "the median scene") +
      panel(lines, &Point::worst_mm, 3, "the worst scene") + "unset multiplot\n";
  draw(options, "work_precision", script);
}

}  // namespace heft
