// In C1 the clone moves as the hand does, so a cube that only it touches moves alike whatever it
// weighs. Cubes that touch cubes share momentum and friction by their masses.
#include <algorithm>
#include <vector>

#include "analysis/Gnuplot.h"
#include "bench/physics/InputStudy.h"
#include "bench/physics/Paths.h"
#include "bench/physics/SceneRun.h"

namespace heft {

namespace {
struct Case {
  const char* name;
  const char* words;                      ///< on two lines
  std::vector<Eigen::Vector2d> places_m;  ///< of the cubes
  StraightPath path;
};

std::vector<Case> cases() {
  StraightPath straight;
  straight.speed_m_s = 0.2;
  StraightPath aside = straight;
  aside.side_m = 0.03;
  StraightPath fling = straight;
  fling.speed_m_s = 0.6;
  fling.length_m = 0.06;
  return {
      {"one_straight", "one cube,\\npushed straight", {{0, 0}}, straight},
      {"one_aside", "one cube,\\npushed at its side", {{0, 0}}, aside},
      {"two_in_line", "a cube pushed\\ninto a second", {{0, 0}, {0.06, 0}}, straight},
      {"two_aside", "a cube pushed into\\na second, off center", {{0, 0}, {0.06, 0.02}}, straight},
      {"thrown", "a cube thrown\\nagainst a second", {{0, 0}, {0.07, 0.01}}, fling}};
}

SceneRun run_with(const Case& one, const std::vector<double>& masses_kg) {
  BenchScene scene;
  scene.name = one.name;
  scene.scene.coupling.decoupled = false;
  for (std::size_t i = 0; i < one.places_m.size(); ++i) {
    Cube cube;
    cube.mass_kg = masses_kg[i];
    cube.position_m.head<2>() = one.places_m[i];
    scene.scene.cubes.push_back(cube);
  }
  scene.path = one.path.rows();
  return run_scene(make_simulator("boxes"), scene, 960, 960);
}

// The largest distance between two runs' cubes at any time.
double apart_mm(const SceneTrack& a, const SceneTrack& b) {
  double most_mm = 0;
  for (std::size_t i = 0; i < std::min(a.states.size(), b.states.size()); ++i)
    for (std::size_t c = 0; c < a.states[i].cubes.size(); ++c)
      most_mm = std::max(
          most_mm,
          1e3 *
              (a.states[i].cubes[c].pose.position_m - b.states[i].cubes[c].pose.position_m).norm());
  return most_mm;
}
}  // namespace

void study_c1_leak(const StudyOptions& options) {
  const std::vector<std::vector<double>> orders_kg{{0.015, 0.8}, {0.2, 0.2}, {0.8, 0.015}};
  CsvFile csv(options, "c1_leak.csv", "case,cubes_apart_max_mm");
  std::string bars = "$bars << END\n";
  for (const Case& one : cases()) {
    const SceneRun first = run_with(one, orders_kg[0]);
    double most_mm = 0;
    for (const auto& masses_kg : orders_kg)
      most_mm = std::max(most_mm, apart_mm(first.track, run_with(one, masses_kg).track));
    csv.row(one.name, most_mm);
    bars += fmt::format("\"{}\" {} \"{:.2g} mm\"\n", one.words, std::max(most_mm, 1e-9), most_mm);
  }
  const std::string caption =
      "Coupled clone (C1). Largest distance, at any time, between the paths that the cubes take "
      "with masses of 15 + 800 g, 200 + 200 g and 800 + 15 g; boxes at 960 steps a second. What is "
      "less than a millionth of a micrometer is drawn as that. " +
      provenance(options);
  draw(
      options, "c1_leak",
      gnuplot_header({"c1_leak.svg", 900, 460,
                      "What C1 gives away: nothing, unless cubes touch cubes", caption}) +
          bars +
          "END\nunset key\nset logscale y\nset yrange [1e-10:1e3]\nset format y '%g'\n"
          "set boxwidth 0.5\nset style fill solid\nset xrange [-0.6:4.6]\n"
          "set xtics font ',10'\nset ylabel 'cubes apart (mm)'\n"
          "set tmargin at screen 1-60*pixel\nset bmargin at screen caption_top + 56*pixel\n"
          "plot $bars using 0:2:xtic(1) with boxes linecolor '#0b5fb4', '' using 0:2:3 with labels "
          "offset 0,0.8 font ',11'\n");
}

}  // namespace heft
