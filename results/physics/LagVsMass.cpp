#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include "analysis/charts/Plot.h"
#include "base/Error.h"
#include "base/SimulationChoices.h"
#include "physics/scene/Oracles.h"
#include "results/physics/PhysicsStudy.h"
#include "results/physics/scenes/RandomScenes.h"
#include "results/physics/scenes/SceneRun.h"

namespace heft {

namespace {
constexpr double travel_m = 0.1;
constexpr int rate_hz = 240;

struct Lag {
  double end_mm = 0, peak_mm = 0;
};

struct Series {
  std::string simulator, technique;
  std::string label;  ///< in the chart; one label for two coincident lines
  double label_g, label_mm;
  bool is_ours() const { return simulator == "boxes"; }
};

const std::vector<Series>& all_series() {
  static const std::vector<Series> series{
      {"bullet-lx", spring_technique, "", 0, 0},
      {"boxes", spring_technique, "C2, the paper's spring: boxes (bullet-lx the same)", 720, 106},
      {"bullet-spring2", spring_technique, "bullet-spring2", 30, 104},
      {"boxes", "gain", "gain .95 at 15 g, .6 at 200 g, .2 at 800 g", 830, 74},
      {"boxes", "speed_limit", "speed limit .5, .08, .05 m/s", 830, 44},
      {"boxes", coupled_technique, "C1, coupled: the same whatever the cube weighs", 720, 4}};
  return series;
}

const MassCurve gains({{0.015, 0.95}, {0.2, 0.6}, {0.8, 0.2}});
const MassCurve limits_m_s({{0.015, 0.5}, {0.2, 0.08}, {0.8, 0.05}});
constexpr double speed_m_s = 0.1;

BenchScene push_of(double mass_g, const std::string& technique) {
  StraightPath path;
  path.speed_m_s = speed_m_s;
  path.length_m = travel_m + 0.002;
  BenchScene scene;
  Cube cube;
  cube.mass_kg = mass_g / 1000;
  scene.scene.cubes = {cube};
  technique_named(technique, {{"gain", Gain{gains}}, {"speed_limit", SpeedLimit{limits_m_s}}}, {})
      .apply_to(scene.scene);
  scene.path = path.rows();
  return scene;
}

double expected_mm(const std::string& technique, double mass_g) {
  const double mass_kg = mass_g / 1000;
  if (technique == coupled_technique) return 0;
  if (technique == "gain") return 1e3 * travel_m * (1 - gains.at(mass_kg));
  if (technique == "speed_limit")
    return 1e3 * travel_m * (1 - std::min(1.0, limits_m_s.at(mass_kg) / speed_m_s));
  return 1e3 * std::min(travel_m, steady_lag_m(0.8, mass_kg, 50));
}

std::optional<Lag> lag_of(const Series& series, double mass_g) {
  const BenchScene scene = push_of(mass_g, series.technique);
  const SceneRun run = run_scene(make_simulator(series.simulator), scene, rate_hz, rate_hz);
  if (run.outcome != RunOutcome::ran) return std::nullopt;
  const Trajectory path(scene.path);
  const double stroke_s = scene.duration_s() - 1;
  Lag lag;
  for (std::size_t i = 0; i < run.track.states.size(); ++i) {
    const double t_s = static_cast<double>(i) / rate_hz;
    if (t_s > stroke_s + 1e-9) break;
    lag.end_mm =
        1e3 * (path.at(t_s)->position_m.x() - run.track.states[i].clone.pose.position_m.x());
    lag.peak_mm = std::max(lag.peak_mm, lag.end_mm);
  }
  return lag;
}

std::vector<double> masses_g(bool quick) {
  if (quick) return {15, 200, 800};
  std::vector<double> masses{15};
  for (int mass = 50; mass <= 1500; mass += 50) masses.push_back(mass);
  return masses;
}

}  // namespace

void study_lag(const StudyOptions& options) {
  CsvFile csv(options, "lag_vs_mass.csv",
              "simulator,technique,rate_hz,cube_mass_g,lag_at_end_mm,peak_lag_mm,expected_mm");
  std::string data = "$closed_form << END\n";
  for (double mass_g : masses_g(options.quick))
    data += fmt::format("{} {}\n", mass_g, expected_mm(spring_technique, mass_g));
  data += "END\n";
  std::string plot =
      "plot $closed_form using 1:2 with lines linewidth 7 linecolor '#cfe0f2' notitle";
  std::string labels;
  std::size_t i = 0;
  for (const Series& series : all_series()) {
    data += fmt::format("$line{} << END\n", i);
    for (double mass_g : masses_g(options.quick)) {
      const auto lag = lag_of(series, mass_g);
      constexpr double none = std::numeric_limits<double>::quiet_NaN();
      const double end_mm = lag ? lag->end_mm : none, peak_mm = lag ? lag->peak_mm : none;
      csv.row(series.simulator, series.technique, rate_hz, mass_g, end_mm, peak_mm,
              expected_mm(series.technique, mass_g));
      if (lag) data += fmt::format("{} {}\n", mass_g, end_mm);
    }
    data += "END\n";
    const bool spring = series.technique == spring_technique;
    const std::string color = color_of(spring ? series.simulator : series.technique);
    plot += fmt::format(", $line{} using 1:2 with lines linewidth {} linecolor '{}' notitle", i,
                        series.is_ours() ? 2.4 : 1.3, color);
    if (!series.label.empty())
      labels += fmt::format("set label {} at {}, {} left textcolor '{}' font ',12'\n",
                            gnuplot_quoted(series.label), series.label_g, series.label_mm, color);
    ++i;
  }
  const std::string caption = fmt::format(
      "Clone behind the effector at the end of a stroke of 10 cm at 0.1 m/s, {} steps a second. "
      "Broad line: min(stroke, \u00b5 M g / k), 0.157 mm a gram, until the cube does not move at "
      "all. {}",
      rate_hz, provenance(options));
  draw(
      options, "lag_vs_mass",
      gnuplot_header({"lag_vs_mass.svg", 900, 560,
                      "How far the clone is behind the hand after a push, against mass", caption}) +
          data + labels +
          "unset key\nset tmargin at screen 1-56*pixel\nset bmargin at screen caption_top + "
          "72*pixel\nset xrange [0:1540]\nset yrange [-3:125]\nset xlabel 'mass of the cube (g)'\n"
          "set ylabel 'clone behind the hand at the end (mm)'\n" +
          plot + "\n");
}

}  // namespace heft
