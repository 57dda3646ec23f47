#include <algorithm>
#include <cmath>
#include <map>

#include "analysis/charts/Plot.h"
#include "base/math/Quantiles.h"
#include "results/physics/PhysicsStudy.h"
#include "results/physics/scenes/RandomScenes.h"
#include "results/physics/scenes/SceneRun.h"

namespace heft {

namespace {
// Of each of four errors. Scenes that exceed one usually exceed others too, so that 99.5 % are
// within all four, see n_over_tolerance.
constexpr double nearly_all = 0.9975;

// A simulator and its measured rates.
struct Entry {
  std::string_view name;
  std::vector<int> rates_hz;
};

std::vector<Entry> entries(bool quick) {
  if (quick) return {{"push", {15}}, {"boxes", {60, 240}}};
  return {{"push", {15}},
          {"boxes", {bench_rates_hz.begin(), bench_rates_hz.end()}},
          {"bullet-lx", {60, 120, 240, 480}}};
}

// Runs of one simulator at one rate through the scenes of one setting.
struct Runs {
  int n_outside = 0, n_blown_up = 0, n_over = 0;
  std::vector<double> clone_mm, lag_g, cubes_mm, turn_deg;

  void add(const SceneRun& run, const SceneTrack& truth, const BenchScene& scene) {
    n_outside += run.outcome == RunOutcome::outside_model;
    n_blown_up += run.outcome == RunOutcome::blew_up;
    if (run.outcome != RunOutcome::ran) return;
    const TrackError error = error_of(run.track, truth, scene);
    clone_mm.push_back(error.clone_rms_mm);
    lag_g.push_back(scene.scene.displacement ? 0 : std::abs(error.lag_error_g));
    cubes_mm.push_back(error.cubes_rms_mm);
    turn_deg.push_back(error.clone_turn_rms_deg);
    n_over += times_tolerance(error, scene) > 1;
  }

  void add(const Runs& more) {
    n_outside += more.n_outside, n_blown_up += more.n_blown_up, n_over += more.n_over;
    for (auto list : {&Runs::clone_mm, &Runs::lag_g, &Runs::cubes_mm, &Runs::turn_deg})
      (this->*list).insert((this->*list).end(), (more.*list).begin(), (more.*list).end());
  }

  std::size_t n_ran() const { return clone_mm.size(); }
};

using Key = std::pair<std::string_view, int>;  // simulator, steps a second

double at(const std::vector<double>& values, double fraction) {
  return quantile(values, fraction).value_or(std::nan(""));
}

void write(CsvFile& csv, std::uint64_t seed, const Key& key, std::string_view setting,
           const Runs& runs) {
  csv.row(fmt::format("{}", seed), key.first, key.second, setting,
          static_cast<double>(runs.n_ran()), runs.n_outside, runs.n_blown_up, runs.n_over,
          at(runs.clone_mm, 0.5), at(runs.clone_mm, 0.95), at(runs.clone_mm, nearly_all),
          at(runs.lag_g, nearly_all), at(runs.cubes_mm, nearly_all), at(runs.turn_deg, nearly_all));
}

// Runs of all settings of a group.
using Group = std::map<Key, Runs>;

// A row of panels for each group; in each panel a line for each simulator over its rates, at the
// median and at a high quantile.
void chart(const StudyOptions& options, const Group& even, const Group& uneven) {
  struct Panel {
    const char* title;
    std::vector<double> Runs::*errors;
    double allowed;
  };
  struct Row {
    const char* words;
    const Group* group;
  };
  const Tolerance allowed;
  const Panel panels[] = {{"clone (mm RMS)", &Runs::clone_mm, 1e3 * allowed.clone_rms_m},
                          {"cubes (mm RMS)", &Runs::cubes_mm, 1e3 * allowed.cubes_rms_m},
                          {"lag (g)", &Runs::lag_g, allowed.lag_g}};
  std::string data, plots;
  int block = 0;
  for (const Row& row : {Row{"through the middle", &even}, {"turning, beside it, stacks", &uneven}})
    for (const Panel& panel : panels) {
      plots +=
          fmt::format("set title {}\nplot {} with lines dashtype 2 linecolor '#999999' notitle",
                      gnuplot_quoted(fmt::format("{}: {}", row.words, panel.title)), panel.allowed);
      for (const std::string_view simulator : {"boxes", "bullet-lx"}) {
        data += fmt::format("$block{} << END\n", block);
        for (const auto& [key, runs] : *row.group)
          if (key.first == simulator)
            data += fmt::format("{} {} {}\n", key.second, at(runs.*panel.errors, 0.5),
                                at(runs.*panel.errors, nearly_all));
        data += "END\n";
        plots += fmt::format(
            ", $block{0} using 1:3 with linespoints pointtype 7 pointsize 0.5 linewidth 2 "
            "linecolor '{1}' title '{2}', $block{0} using 1:2 with lines linewidth 1 linecolor "
            "'{1}' notitle",
            block++, color_of(simulator), simulator);
      }
      plots += "\nunset label\nunset key\n";  // once
    }
  const std::string caption = fmt::format(
      "Random scenes: minimum-jerk strokes that sway and tremble, seen at 15 to 60 Hz. "
      "Upper row: within 4 mm of the middle of one to three cubes on the table, half of them "
      "with contacts that yield; lower row: hands that turn by up to 35 degrees, push up to "
      "30 mm beside the middle or move stacked cubes, all with such contacts. "
      "Thick: what 99.75 % stay within; thin: the median. Dashed: what auto tolerates. "
      "Truth: boxes at {} Hz. {}",
      16 * reference_rate_hz, provenance(options));
  draw(options, "hands",
       gnuplot_header({"hands.svg", 1300, 840, "Hands as they are: error against rate", caption}) +
           data +
           "set logscale xy\nset format y '%g'\nset xtics (15, 60, 240, 960)\n"
           "set xlabel 'steps a second'\nset key bottom left font ',10'\nset yrange [1e-4:100]\n"
           "set multiplot layout 2,3 margins screen 0.065, screen 0.985, screen caption_top + "
           "84*pixel, screen 1-80*pixel spacing screen 0.065, screen 135*pixel\n" +
           plots + "unset multiplot\n");
}
}  // namespace

void study_hands(const StudyOptions& options) {
  CsvFile csv(options, "hands.csv",
              "seed,simulator,rate_hz,setting,n_ran,n_outside_model,n_blew_up,n_over_tolerance,"
              "median_clone_rms_mm,p95_clone_rms_mm,most_clone_rms_mm,most_lag_g,"
              "most_cubes_rms_mm,most_turn_deg");
  const auto& settings = EnumNames<Setting>::names;
  const int n_each = options.quick ? 1 : 100;
  Group even, uneven;
  StudyProgress progress(static_cast<int>(settings.size()));
  for (std::size_t s = 0; s < settings.size(); ++s) {
    progress.next(fmt::format("hands of seed {}: {}", options.seed, settings[s]));
    Group here;
    for (int n = 0; n < n_each; ++n) {
      const BenchScene scene = random_hands(static_cast<Setting>(s), options.seed, n);
      const int poses_hz = poses_hz_of(scene);
      const auto run = [&](std::string_view name, int rate_hz) {
        return run_scene(make_simulator(name), scene, rate_hz, poses_hz, poses_hz);
      };
      const SceneTrack truth = run("boxes", 16 * reference_rate_hz).track;
      for (const auto& [name, rates_hz] : entries(options.quick))
        for (int rate_hz : rates_hz)
          if (name != "push" ||
              (static_cast<Setting>(s) == Setting::straight && scene.unique_if_rigid()))
            here[{name, rate_hz}].add(run(name, rate_hz), truth, scene);
    }
    for (const auto& [key, runs] : here) {
      write(csv, options.seed, key, settings[s], runs);
      (has_one_answer(static_cast<Setting>(s)) ? even : uneven)[key].add(runs);
    }
  }
  for (const auto& [key, runs] : even) write(csv, options.seed, key, "even", runs);
  for (const auto& [key, runs] : uneven) write(csv, options.seed, key, "uneven", runs);
  chart(options, even, uneven);
}

}  // namespace heft
