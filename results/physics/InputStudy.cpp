#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "analysis/charts/Plot.h"
#include "base/Pose.h"
#include "base/Random.h"
#include "base/SimulationChoices.h"
#include "results/physics/PhysicsStudy.h"
#include "results/physics/scenes/RandomScenes.h"
#include "results/physics/scenes/SceneRun.h"

namespace heft {

namespace {
constexpr const char* simulator_name = "boxes";
constexpr int physics_rate_hz = 240, width_px = 1400;
constexpr double duration_s = 4;

// A camera's effect on the hand's motion.
enum class Fault { none, jitter, missing, noise };
constexpr std::array<Fault, 4> all_faults{Fault::none, Fault::jitter, Fault::missing, Fault::noise};
constexpr std::array all_modes{InputMode::path, InputMode::smooth, InputMode::hold,
                               InputMode::extrapolate};
constexpr double noise_m = 0.2e-3;

const char* words_of(Fault fault) {
  switch (fault) {
    case Fault::none:
      return "clean";
    case Fault::jitter:
      return "2 ms jitter";
    case Fault::missing:
      return "1 in 10 missing";
    case Fault::noise:
      return "0.2 mm noise";
  }
  return "";
}

// Scenes with a unique solution, so that differences come from the input.
struct Case {
  const char* name;
  bool decoupled, cube;

  // In the air 10 cm back and forth once a second; at a cube 10 cm forth and back in 2 s.
  Pose hand_at(double t_s) const {
    if (!cube) return upright_pose({0.05 * std::sin(2 * M_PI * t_s), 0, 0.2}, 0);
    const double along_m = 0.05 * (1 - std::cos(M_PI * t_s));
    return upright_pose({before_cube_m + along_m, 0, hand_height_m}, 0);
  }

  Scene scene() const {
    Scene scene;
    if (cube) scene.cubes = {Cube{}};
    scene.coupling.decoupled = decoupled;
    return scene;
  }
};
constexpr std::array<Case, 3> cases{
    {{"free_air", true, false}, {"push", true, true}, {"push", false, true}}};

// Records the clone's position after each step of another simulator.
class Watched : public DecouplingSimulator {
 public:
  struct Seen {
    double t_s;
    Eigen::Vector3d clone_m;
    double cube_speed_m_s;
  };

  Watched(std::unique_ptr<DecouplingSimulator> simulator, std::vector<Seen>& seen)
      : simulator_(std::move(simulator)), seen_(seen) {}
  void reset(const Scene& scene, const Pose& target) override {
    simulator_->reset(scene, target);
    see();
  }
  void step(const Pose& target, double h_s) override {
    simulator_->step(target, h_s);
    t_s_ += h_s;
    see();
  }
  void teleport_clone(const Pose& target, const Velocity& velocity) override {
    simulator_->teleport_clone(target, velocity);
  }
  void set_clone_solid(bool solid) override { simulator_->set_clone_solid(solid); }
  void place_cube(int cube, const Pose& pose) override { simulator_->place_cube(cube, pose); }
  WorldState state() const override { return simulator_->state(); }

 private:
  void see() {
    const WorldState state = simulator_->state();
    const double cube_m_s = state.cubes.empty() ? 0 : state.cubes[0].velocity.linear_m_s.norm();
    seen_.push_back({t_s_, state.clone.pose.position_m, cube_m_s});
  }

  std::unique_ptr<DecouplingSimulator> simulator_;
  std::vector<Seen>& seen_;
  double t_s_ = 0;
};

// The clone under a continuously known hand, at n / reference_rate_hz.
std::vector<Eigen::Vector3d> truth_of(const Case& one) {
  constexpr int finer = 8;
  const auto simulator = make_simulator(simulator_name);
  simulator->reset(one.scene(), one.hand_at(0));
  std::vector<Eigen::Vector3d> clone_m{simulator->state().clone.pose.position_m};
  const int n = static_cast<int>(duration_s * reference_rate_hz) * finer;
  for (int i = 1; i <= n; ++i) {
    simulator->step(one.hand_at(i / (1.0 * finer * reference_rate_hz)),
                    1.0 / (finer * reference_rate_hz));
    if (i % finer == 0) clone_m.push_back(simulator->state().clone.pose.position_m);
  }
  return clone_m;
}

Eigen::Vector3d at(const std::vector<Eigen::Vector3d>& truth_m, double t_s) {
  const double place =
      std::clamp(t_s * reference_rate_hz, 0.0, static_cast<double>(truth_m.size() - 1));
  const auto i = std::min(static_cast<std::size_t>(place), truth_m.size() - 2);
  const double s = place - static_cast<double>(i);
  return (1 - s) * truth_m[i] + s * truth_m[i + 1];
}

// One sample for each picture, with the hand's true pose and velocity at the true time. Noise of
// poses adds the noise of the velocities that a tracker derives from them.
std::vector<TargetSample> samples_of(const Case& one, int camera_hz, Fault fault) {
  RandomStream random(7, "bench input");
  std::vector<TargetSample> samples;
  for (int i = 0; i <= static_cast<int>(duration_s * camera_hz); ++i) {
    const double t_s = i / static_cast<double>(camera_hz);
    const double off_s = 0.002 * random.normal(), x = random.normal(), y = random.normal();
    const double vx = random.normal(), vy = random.normal();
    const bool lost = random.coin(0.1);
    if (fault == Fault::missing && lost && i > 0) continue;
    TargetSample sample;
    sample.t_capture_s =
        fault == Fault::jitter && i > 0 ? t_s + std::clamp(off_s, -0.006, 0.006) : t_s;
    sample.pose = one.hand_at(t_s);
    sample.velocity = mean_velocity(one.hand_at(t_s - 1e-5), one.hand_at(t_s + 1e-5), 2e-5);
    if (fault == Fault::noise) {
      sample.pose.position_m += noise_m * Eigen::Vector3d(x, y, 0);
      sample.velocity.linear_m_s += noise_m * camera_hz / 2 * Eigen::Vector3d(vx, vy, 0);
    }
    samples.push_back(sample);
  }
  return samples;
}

struct InputError {
  double at_picture_mm = 0;  ///< of the world drawn over a picture, at the picture's time
  double at_present_mm = 0;  ///< of the displayed world, at the time of display
  double fastest_cube_m_s = 0;
};

double rms_mm(const std::vector<double>& squares) {
  double sum = 0;
  for (double square : squares) sum += square;
  return 1e3 * std::sqrt(sum / static_cast<double>(squares.size()));
}

InputError error_of(InputMode mode, const Case& one, const std::vector<TargetSample>& samples,
                    const std::vector<Eigen::Vector3d>& truth_m) {
  std::vector<Watched::Seen> seen;
  Drive drive(std::make_unique<Watched>(make_simulator(simulator_name), seen), one.scene(),
              physics_rate_hz, {mode});
  std::vector<double> picture_m2, present_m2;
  std::vector<Watched::Seen> pictures;
  for (const TargetSample& sample : samples) {
    const Eigen::Vector3d clone_m = drive.advance(sample).clone.pose.position_m;
    pictures.push_back({sample.t_capture_s, clone_m, 0});
    picture_m2.push_back((clone_m - at(truth_m, sample.t_capture_s)).squaredNorm());
  }
  // Over video, the last picture's world is shown until the next picture.
  std::size_t picture = 0;
  InputError error;
  for (const Watched::Seen& now : seen) {
    while (picture + 1 < pictures.size() && pictures[picture + 1].t_s <= now.t_s + 1e-9) ++picture;
    const Eigen::Vector3d shown_m = mode == InputMode::path || mode == InputMode::smooth
                                        ? pictures[picture].clone_m
                                        : now.clone_m;
    present_m2.push_back((shown_m - at(truth_m, now.t_s)).squaredNorm());
    error.fastest_cube_m_s = std::max(error.fastest_cube_m_s, now.cube_speed_m_s);
  }
  error.at_picture_mm = rms_mm(picture_m2);
  error.at_present_mm = rms_mm(present_m2);
  return error;
}

const char* color_of(InputMode mode) {
  constexpr std::array<const char*, 4> colors{"#0b5fb4", "#d95f02", "#1b7f3b", "#8e44ad"};
  return colors[static_cast<std::size_t>(mode)];
}

using Dots = std::map<InputMode, std::string>;

std::string dots_of(const Dots& dots, const char* panel) {
  std::string script;
  for (const auto& [mode, rows] : dots)
    script += fmt::format("${}_{} << END\n{}END\n", panel, name_of(mode), rows);
  return script;
}

// Under the title, each word in its color.
std::string legend() {
  std::string script;
  int x_px = 90;
  for (InputMode mode : all_modes) {
    script += fmt::format(
        "set label '\u25cf {}' at screen {}, screen 1-44*pixel font ',12' textcolor '{}'\n",
        name_of(mode), x_px / static_cast<double>(width_px), color_of(mode));
    x_px += 110;
  }
  return script;
}

std::string panel(const char* name, const char* title) {
  std::string script = fmt::format("set title '{}' font ',13'\nplot ", title);
  for (InputMode mode : all_modes)
    script += fmt::format(
        "${0}_{1} using 1:2 with points pointtype 7 pointsize 1 linecolor '{2}' notitle, ", name,
        name_of(mode), color_of(mode));
  return script + "NaN notitle\n";
}
}  // namespace

void study_input(const StudyOptions& options) {
  CsvFile csv(options, "input.csv",
              "scene,condition,camera_hz,fault,mode,clone_at_picture_rms_mm,"
              "clone_at_present_rms_mm,fastest_cube_m_s");
  Dots in_air, at_picture, at_present, kicks;
  std::string tics;
  for (const Case& one : cases) {
    const std::vector<Eigen::Vector3d> truth_m = truth_of(one);
    int place = 0;
    for (int camera_hz : {15, 30, 60}) {
      for (Fault fault : all_faults) {
        if (!one.cube)
          tics +=
              fmt::format("{}'{} Hz, {}' {}", place ? ", " : "", camera_hz, words_of(fault), place);
        const std::vector<TargetSample> samples = samples_of(one, camera_hz, fault);
        for (InputMode mode : all_modes) {
          const InputError error = error_of(mode, one, samples, truth_m);
          csv.row(one.name, default_technique(one.decoupled), camera_hz, words_of(fault),
                  name_of(mode), error.at_picture_mm, error.at_present_mm, error.fastest_cube_m_s);
          const auto dot = [&](double y) {
            return fmt::format("{} {}\n", place + 0.2 * (static_cast<int>(mode) - 1.5), y);
          };
          if (!one.cube) in_air[mode] += dot(error.at_picture_mm);
          if (one.cube && one.decoupled) at_picture[mode] += dot(error.at_picture_mm);
          if (one.cube && one.decoupled) at_present[mode] += dot(error.at_present_mm);
          if (!one.decoupled) kicks[mode] += dot(error.fastest_cube_m_s);
        }
        ++place;
      }
    }
  }
  const std::string caption =
      "A hand seen by a camera: 10 cm back and forth in free air once a second, and forth and back "
      "in 2 s at a cube of 200 g. Error of the clone against physics that knew the hand at all "
      "times (boxes, 240 steps a second). path: straight between the last two poses; smooth: on "
      "the cubic through their velocities; both shown with the later picture; hold: the last pose; "
      "extrapolate: on along the last two. " +
      provenance(options);
  draw(options, "input",
       gnuplot_header({"input.svg", width_px, 1000,
                       "From camera poses to a target: what each way of filling the gaps costs",
                       caption}) +
           legend() + dots_of(in_air, "air") + dots_of(at_picture, "picture") +
           dots_of(at_present, "present") + dots_of(kicks, "kick") +
           fmt::format(
               "set logscale y\nset format y '%g'\nset xrange [-0.6:11.6]\n"
               "set xtics rotate by 45 right font ',11' ({})\n"
               "set arrow 1 from 3.5, graph 0 to 3.5, graph 1 nohead linecolor '#cccccc'\n"
               "set arrow 2 from 7.5, graph 0 to 7.5, graph 1 nohead linecolor '#cccccc'\n"
               "unset key\n"
               "set multiplot layout 2,2 margins screen 0.065, screen 0.985, screen "
               "caption_top + 110*pixel, screen 1-95*pixel spacing screen 0.07, screen 170*pixel\n"
               "set ylabel 'error of the clone (mm RMS)'\nset yrange [0.0005:20]\n",
               tics) +
           panel("air", "free air, over video: at the picture''s time") + "unset label\n" +
           panel("picture", "a cube, over video") +
           panel("present", "a cube, see-through: at the present") +
           "set ylabel 'fastest cube (m/s)'\nset yrange [0.1:10]\n" +
           panel("kick", "C1: how a cube is kicked (hand: 0.16 m/s)") + "unset multiplot\n");
}

}  // namespace heft
