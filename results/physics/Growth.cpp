// Cost of a step against the number of cubes: asleep, apart while one is pushed, in a row.
#include "analysis/charts/Plot.h"
#include "results/physics/PhysicsStudy.h"
#include "results/physics/scenes/RandomScenes.h"
#include "results/physics/scenes/SceneRun.h"

namespace heft {

namespace {
constexpr int rate_hz = 240;

enum class Standing { asleep, apart, row };
constexpr std::array<std::string_view, 3> standings{"asleep", "apart", "row"};

BenchScene scene_of(Standing standing, int n_cubes) {
  BenchScene scene;
  StraightPath path;
  path.length_m = 0.08;
  scene.path = path.rows();
  if (standing == Standing::asleep)
    for (TrajectoryRow& row : scene.path) row.pose->position_m.z() = 0.3;
  const bool row = standing == Standing::row;
  const int n_abreast = row ? 1 : 8;
  const double pitch_m = row ? 0.035 : 0.085;
  for (int i = 0; i < n_cubes; ++i) {
    Cube cube;
    cube.mass_kg = 0.02;
    const int column = i / n_abreast, place = i % n_abreast;
    cube.position_m.x() = pitch_m * column;
    cube.position_m.y() = pitch_m * place;
    scene.scene.cubes.push_back(cube);
  }
  return scene;
}
}  // namespace

void study_growth(const StudyOptions& options) {
  CsvFile csv(options, "growth.csv", "simulator,standing,n_cubes,us_per_step");
  std::string data, plot = "plot ";
  for (const std::string_view simulator : {"boxes", "bullet-lx"}) {
    for (std::size_t s = 0; s < standings.size(); ++s) {
      data += fmt::format("$line{}_{} << END\n", s, simulator == "boxes");
      for (int n_cubes : {1, 2, 4, 8, 16, 32, 64}) {
        if (options.quick && n_cubes > 2) break;
        const BenchScene scene = scene_of(static_cast<Standing>(s), n_cubes);
        const double us = cpu_us_per_s(simulator_named(simulator), scene, rate_hz, 0) / rate_hz;
        csv.row(simulator, standings[s], n_cubes, us);
        data += fmt::format("{} {}\n", n_cubes, us);
      }
      data += "END\n";
      plot += fmt::format(
          "$line{}_{} using 1:2 with linespoints pointtype 7 pointsize 0.6 linewidth 2 dashtype {} "
          "linecolor '{}' title '{}, {}', ",
          s, simulator == "boxes", s + 1, color_of(simulator), simulator, standings[s]);
    }
  }
  draw(options, "growth",
       gnuplot_header(
           {"growth.svg", 900, 520, "What more cubes cost",
            "Cubes of 20 g that nobody touches; that stand apart, one of them pushed; "
            "that touch in a row, pushed at its end. CPU time of a step at 240 a second. " +
                provenance(options)}) +
           data +
           "set logscale xy\nset format y '%g'\nset xtics (1, 2, 4, 8, 16, 32, 64)\n"
           "set xlabel 'cubes'\nset ylabel 'a step (\u00b5s)'\nset key top left font ',11'\n"
           "set tmargin at screen 1-50*pixel\nset bmargin at screen caption_top + 72*pixel\n" +
           plot + "NaN notitle\n");
}

}  // namespace heft
