#include "results/physics/scenes/RandomScenes.h"

#include <fmt/format.h>

#include <cmath>

#include "base/PoseTypes.h"
#include "base/Random.h"

namespace heft {

namespace {
constexpr double side_m = 0.035;

double between(RandomStream& random, double low, double high) {
  return low + (high - low) * random.uniform();
}

double mass_kg(RandomStream& random, double from_kg = 0.015, double to_kg = 1.5) {
  return from_kg * std::pow(to_kg / from_kg, random.uniform());
}

// From 0 to 1 with speed and acceleration zero at both ends (Flash and Hogan, 1985).
double minimum_jerk(double s) {
  s = std::clamp(s, 0.0, 1.0);
  return s * s * s * (10 + s * (6 * s - 15));
}

// A hand that pushes a few times along x and returns in between.
struct Hand {
  double start_m = 0, aside_m = 0, yaw_rad = 0, turn_rad = 0;
  double length_m = 0, stroke_s = 0, back = 0;
  int n_strokes = 1;
  double sway_m = 0, sway_hz = 0, wag_rad = 0, tremor_m = 0, tremor_hz = 0, phase = 0;

  double duration_s() const { return n_strokes * (2 * stroke_s + 0.2) + 0.2; }

  double along_m(double t_s) const {
    double at_m = 0;
    for (int i = 0; i < n_strokes; ++i) {
      const double from_s = 0.05 + i * (2 * stroke_s + 0.2);
      at_m += length_m * (minimum_jerk((t_s - from_s) / stroke_s) -
                          back * minimum_jerk((t_s - from_s - stroke_s - 0.1) / stroke_s));
    }
    return at_m;
  }

  Pose at(double t_s) const {
    const double w = 2 * M_PI * t_s, sway = std::sin(sway_hz * w + phase) - std::sin(phase);
    const double tremble = tremor_m * std::sin(tremor_hz * w);
    const Eigen::Vector3d place_m(start_m + along_m(t_s) + tremble,
                                  aside_m + sway_m * sway + tremble / 2,
                                  hand_height_m + 0.5 * sway_m * sway * sway);
    return upright_pose(place_m,
                        yaw_rad + wag_rad * sway + turn_rad * minimum_jerk(t_s / (2 * stroke_s)));
  }
};

Hand hand_of(RandomStream& random, Setting setting) {
  Hand hand;
  hand.start_m = before_cube_m - between(random, 0, 0.02);
  hand.aside_m = between(random, -0.004, 0.004);
  hand.length_m = between(random, 0.04, 0.14);
  const double peak_m_s = between(random, 0.05, setting == Setting::thrown ? 1.0 : 0.5);
  hand.stroke_s = 1.875 * hand.length_m / peak_m_s;
  hand.n_strokes = random.coin(0.3) ? 2 : 1;
  hand.back = between(random, 0.2, 1);
  hand.sway_m = between(random, 0, 0.002);
  hand.sway_hz = between(random, 0.3, 2);
  hand.tremor_m = between(random, 0, 0.1e-3);
  hand.tremor_hz = between(random, 8, 12);
  hand.phase = between(random, 0, 2 * M_PI);
  if (setting == Setting::straight) hand.sway_m = hand.tremor_m = 0;
  if (setting == Setting::aside) hand.aside_m = between(random, -0.03, 0.03);
  if (setting == Setting::aside || setting == Setting::turning)
    hand.wag_rad = between(random, 0, 0.05);
  if (setting == Setting::turning) hand.turn_rad = between(random, -0.6, 0.6);
  if (setting == Setting::pair || setting == Setting::staggered) hand.yaw_rad = M_PI / 2;
  if (hand.yaw_rad > 0) hand.start_m += 0.025;  // the effector is that much shorter ahead
  return hand;
}

std::vector<Cube> cubes_of(RandomStream& random, Setting setting) {
  const auto cube = [&](double x_m, double y_m, double level = 0) {
    Cube one;
    one.mass_kg = mass_kg(random);
    one.position_m = {x_m, y_m, (level + 0.5) * side_m};
    return one;
  };
  switch (setting) {
    case Setting::pair:
      return {cube(0, -0.021), cube(0, 0.021)};
    case Setting::staggered:
      return {cube(0, -0.021), cube(between(random, 0, 0.02), 0.021)};
    case Setting::row:
      return {cube(0, 0), cube(side_m + between(random, 0, 0.03), 0),
              cube(2 * side_m + between(random, 0.03, 0.06), 0)};
    case Setting::stack:
      return {cube(0, 0), cube(0, 0, 1)};
    case Setting::tower:
      return {cube(0, 0), cube(0, 0, 1), cube(0, 0, 2)};
    default:
      break;
  }
  std::vector<Cube> one{cube(0, 0)};
  if (setting == Setting::thrown) one[0].mass_kg = mass_kg(random, 0.005, 0.05);
  return one;
}

// Adds a camera's sampling and noise.
std::vector<TrajectoryRow> seen(RandomStream& random, const Hand& hand) {
  constexpr std::array<double, 3> rates_hz{15, 30, 60};
  const double rate_hz = rates_hz[random.below(3)];
  const double noise_m = hand.sway_m > 0 ? between(random, 0, 0.2e-3) : 0;
  PathBuilder path;
  for (int i = 0; i <= static_cast<int>(hand.duration_s() * rate_hz); ++i) {
    Pose pose = hand.at(i / rate_hz);
    pose.position_m += noise_m * Eigen::Vector3d(random.normal(), random.normal(), 0);
    path.to(i / rate_hz, pose.position_m,
            2 * std::atan2(pose.orientation.z(), pose.orientation.w()));
  }
  return path.rows();
}
}  // namespace

int poses_hz_of(const BenchScene& scene) {
  return static_cast<int>(std::lround(1 / (scene.path[1].t_s - scene.path[0].t_s)));
}

BenchScene random_scene(Setting setting, std::uint64_t seed, int n) {
  RandomStream random(seed, name_of(setting), static_cast<std::uint64_t>(n));
  BenchScene scene;
  scene.name = fmt::format("{} {} of seed {}", name_of(setting), n, seed);
  scene.scene.cubes = cubes_of(random, setting);
  scene.path = seen(random, hand_of(random, setting));
  if (!has_one_answer(setting)) scene.scene.contact_compliance_m_per_n = random_compliance_m_per_n;
  const MassCurve gains({{0.015, 0.95}, {0.2, 0.6}, {0.8, 0.2}});
  const MassCurve limits_m_s({{0.015, 0.5}, {0.2, 0.15}, {0.8, 0.05}});
  if (setting == Setting::gain) Technique{"", Gain{gains}}.apply_to(scene.scene);
  if (setting == Setting::speed_limit) Technique{"", SpeedLimit{limits_m_s}}.apply_to(scene.scene);
  if (setting == Setting::coupled) scene.scene.coupling.decoupled = false;
  return scene;
}

BenchScene random_hands(Setting setting, std::uint64_t seed, int n) {
  BenchScene scene = random_scene(setting, seed, n);
  if (n % 2 == 1) scene.scene.contact_compliance_m_per_n = random_compliance_m_per_n;
  return scene;
}

}  // namespace heft
