// heft scene: physics alone. Reads a scene and the effector's path, prints the clone's and the
// cubes' paths as CSV.
#include "physics/scene/Scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "base/Error.h"
#include "cli/Commands.h"
#include "cli/SessionOptions.h"
#include "cli/console/Terminal.h"
#include "experiment/Trajectory.h"
#include "physics/Drive.h"
#include "physics/auto/Choice.h"
#include "protocol/readers/Files.h"

namespace heft::cli {

namespace {
struct SceneOptions {
  std::string scene, trajectory, simulator = "boxes";
  double rate_hz = 240;
  bool explain = false;
};

std::string header(std::size_t n_cubes) {
  std::string line = "t_s";
  const auto add_body = [&](const std::string& body) {
    for (const char* column : {"x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"})
      line += fmt::format(",{}_{}", body, column);
  };
  add_body("clone");
  for (std::size_t i = 1; i <= n_cubes; ++i) add_body(fmt::format("cube{}", i));
  return line;
}

// The names, and the known defects of some.
std::string simulator_help() {
  std::string text = "one of";
  for (const SimulatorEntry& entry : simulators()) text += fmt::format(" {}", entry.name);
  for (const SimulatorEntry& entry : simulators())
    if (!entry.warning.empty()) text += fmt::format("\n{} {}", entry.name, entry.warning);
  return text;
}

// Shortest digits that read back as the same doubles.
std::string cells(const Pose& pose) {
  const auto& p = pose.position_m;
  const auto& q = pose.orientation;
  return fmt::format(",{},{},{},{},{},{},{}", p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z());
}

// The clone's cells are empty while the effector is out of view.
std::string row(double t_s, const WorldState& state) {
  std::string line = fmt::format("{}", t_s);
  line += state.clone_present ? cells(state.clone.pose) : std::string(7, ',');
  for (const BodyState& cube : state.cubes) line += cells(cube.pose);
  return line;
}

bool is_finite(const WorldState& state) {
  const auto good = [](const Pose& pose) {
    return pose.position_m.allFinite() && pose.orientation.coeffs().allFinite();
  };
  return (!state.clone_present || good(state.clone.pose)) &&
         std::ranges::all_of(state.cubes, [&](const BodyState& cube) { return good(cube.pose); });
}

// Drive treats a longer interval between two poses as a gap in tracking.
void check(const SceneOptions& options) {
  if (options.rate_hz >= 4 && options.rate_hz <= 1e6) return;
  throw Error(fmt::format("--rate {}: expected 4 to 1000000 Hz", options.rate_hz), ExitCode::usage);
}

// Calls `take` with a row every 1 / rate seconds. The drive gets every row of the trajectory.
template <typename Take>
void run(Drive& drive, const Trajectory& trajectory, double rate_hz, const Take& take) {
  const double start_s = trajectory.start_s();
  const auto last = static_cast<long>(std::floor((trajectory.end_s() - start_s) * rate_hz + 1e-6));
  const double rounding_s = 1e-6 / rate_hz;
  auto next = trajectory.rows().begin();
  for (long n = 0; n <= last; ++n) {
    const double t_s = start_s + static_cast<double>(n) / rate_hz;
    for (; next->t_s < t_s - rounding_s; ++next) drive.advance(sample_of(next->t_s, next->pose));
    const WorldState& state = drive.advance(sample_of(t_s, trajectory.at(t_s)));
    if (next->t_s < t_s + rounding_s && std::next(next) != trajectory.rows().end()) ++next;
    if (!is_finite(state))
      throw Error(fmt::format(
          "at {:.3f} s a pose is not a number: values of the scene or the path are far outside "
          "of a table's and a hand's range",
          t_s));
    take(row(t_s, state));
  }
}

void explain_solves(const SceneOptions& options, const Drive& drive) {
  const std::optional<SolveCounts> counts = drive.counts();
  if (options.explain && counts)
    say("heft: {} collisions; {} solves did not converge\n", counts->hits, counts->not_converged);
}

// Tries simulators from simple to general until one models the whole path; prints only its rows.
void run_auto(const SceneOptions& options, const Scene& scene, const Trajectory& trajectory) {
  const auto explain = [&](const std::string& what) {
    if (options.explain) say("heft: {}\n", what);
  };
  const std::vector<SimulatorPick> ladder = simulator_ladder(scene, options.rate_hz);
  for (const SimulatorPick& pick : ladder) {
    explain(described(pick));
    std::string rows;
    try {
      Drive drive(make_simulator(pick.simulator), scene, pick.rate_hz);
      run(drive, trajectory, options.rate_hz,
          [&](const std::string& line) { rows += line + '\n'; });
      explain_solves(options, drive);
    } catch (const OutsideModel& outside) {
      if (&pick == &ladder.back()) throw;
      explain(
          fmt::format("{} does not model this: {}; starting over", pick.simulator, outside.what()));
      continue;
    }
    fmt::print("{}\n{}", header(scene.cubes.size()), rows);
    return;
  }
}

void run_named(const SceneOptions& options, const Scene& scene, const Trajectory& trajectory) {
  const SimulatorEntry& entry = simulator_named(options.simulator);
  warn_of_simulator(options.simulator);
  if (options.explain)
    say("heft: {} at {:g} Hz, as requested: {}\n", entry.name, options.rate_hz, entry.summary);
  if (scene.contact_compliance_m_per_n > 0 && !models_compliance(entry.name))
    say("heft: {}'s contacts are rigid: contact_compliance_m_per_n has no effect\n", entry.name);
  long n_rows = 0;
  try {
    Drive drive(entry.make(), scene, options.rate_hz);
    fmt::print("{}\n", header(scene.cubes.size()));
    run(drive, trajectory, options.rate_hz, [&](const std::string& line) {
      fmt::print("{}\n", line);
      ++n_rows;
    });
    explain_solves(options, drive);
  } catch (const OutsideModel& outside) {
    const double t_s = trajectory.start_s() + static_cast<double>(n_rows) / options.rate_hz;
    throw Error(
        fmt::format("{} at {:.3f} s: {}; --simulator boxes models this, and --simulator "
                    "auto chooses a suitable one",
                    entry.name, t_s, outside.what()));
  }
}

void run_scene(const SceneOptions& options) {
  check(options);
  simulator_named(options.simulator);  // throws if there is none of that name
  const Scene scene = load_scene(options.scene);
  const Trajectory trajectory = load_trajectory(options.trajectory);
  (options.simulator == "auto" ? run_auto : run_named)(options, scene, trajectory);
}
}  // namespace

void add_scene(Command& app) {
  Command command = app.add_command(
      "scene", "physics alone: effector poses in, clone and cube poses out (CSV)",
      {"heft scene SCENE.toml --trajectory T.csv > out.csv",
       "heft scene SCENE.toml --trajectory T.csv --simulator bullet-ea --rate 60",
       "heft scene SCENE.toml --trajectory T.csv --simulator auto --rate 60 --explain > out.csv"});
  command.is_minor();
  const auto options = std::make_shared<SceneOptions>();
  command.add_option("SCENE.toml", &options->scene, "a scene file").required();
  command
      .add_option("--trajectory", &options->trajectory,
                  "effector path: CSV t_s,x_m,y_m,z_m,qw,qx,qy,qz")
      .required();
  command.add_option("--simulator", &options->simulator, simulator_help()).shows_default();
  command.add_option("--rate", &options->rate_hz, "physics steps and rows per second")
      .shows_default();
  command.add_flag("--explain", options->explain,
                   "print on stderr which simulator and step are used, and why");
  command.does([options] { run_scene(*options); });
}

}  // namespace heft::cli
