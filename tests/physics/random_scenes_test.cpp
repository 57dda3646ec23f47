// `boxes` against SlidingReference in random scenes with a unique rigid solution: strokes, oblique
// strokes, chains, pairs pushed by the long side, stacks.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <numbers>
#include <random>

#include "base/Pose.h"
#include "physics/DecouplingSimulator.h"
#include "physics/Pushes.h"
#include "physics/SlidingReference.h"

namespace heft {
namespace {

constexpr int picture_hz = 60;

struct RandomScene {
  std::string kind;
  Scene scene;
  double heading_rad = 0;
  bool turned = false;     ///< the effector's long side goes first
  std::vector<Pose> hand;  ///< 60 times a second; straight in between
};

class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(random_() >> 11) * 0x1p-53);
  }
  double log_between(double low, double high) { return low * std::pow(high / low, between(0, 1)); }
  int up_to(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }

 private:
  std::mt19937_64 random_;
};

/// Fraction of a stroke at a fraction of its time: constant speed, minimum jerk, or out and half of
/// the way back.
double course(int kind, double s) {
  s = std::clamp(s, 0.0, 1.0);
  if (kind == 0) return s;
  const double smooth = s * s * s * (10 + s * (6 * s - 15));
  return kind == 1 ? smooth : std::sin(0.75 * std::numbers::pi * smooth);
}

// A cube whose center is at these distances along the heading and beside it.
Cube placed(const RandomScene& in, double mass_kg, double along_m, double beside_m) {
  Cube cube;
  cube.mass_kg = mass_kg;
  cube.yaw_rad = in.heading_rad;
  const double c = std::cos(in.heading_rad), s = std::sin(in.heading_rad);
  cube.position_m = {along_m * c - beside_m * s, along_m * s + beside_m * c, 0.0175};
  return cube;
}

RandomScene random_scene(unsigned seed) {
  Draw draw(seed);
  RandomScene made;
  made.heading_rad = draw.between(-3.1, 3.1);
  const auto mass_kg = [&] { return draw.log_between(0.007, 0.6); };
  double beside_m = 0, hand_z_m = 0.0215, drift_m = 0;
  static const std::array<std::string, 5> kinds{"stroke", "oblique", "chain", "pair", "stack"};
  made.kind = kinds[seed % kinds.size()];
  if (made.kind == "stroke" || made.kind == "oblique") {
    made.scene.cubes = {placed(made, mass_kg(), 0, 0)};
    if (made.kind == "oblique") drift_m = draw.between(-0.03, 0.03);
  } else if (made.kind == "chain") {
    double along_m = 0;
    for (int i = 0, n = 2 + draw.up_to(2); i < n; ++i) {
      made.scene.cubes.push_back(placed(made, mass_kg(), along_m, 0));
      along_m += 0.035 + (draw.up_to(3) == 0 ? 0 : draw.between(0, 0.025));
    }
  } else if (made.kind == "pair") {
    made.turned = true;
    made.scene.cubes = {placed(made, mass_kg(), 0, -0.02),
                        placed(made, mass_kg(), draw.between(0, 0.02), 0.02)};
  } else {
    made.scene.effector_size_m = {0.09, 0.04, 0.015};
    hand_z_m = 0.0095;
    made.scene.cubes = {placed(made, mass_kg(), 0, 0), placed(made, mass_kg(), 0, 0)};
    made.scene.cubes[0].size_m = {0.06, 0.06, 0.02};
    made.scene.cubes[1].size_m = {0.03, 0.03, 0.02};
    made.scene.cubes[0].position_m.z() = 0.01;
    made.scene.cubes[1].position_m.z() = 0.03;
  }
  const double reach_m = (made.turned ? 0.02 : 0.045) + made.scene.cubes[0].size_m.x() / 2;
  const double from_m = -reach_m - draw.between(0.001, 0.02);
  const double length_m = draw.between(0.03, 0.15), speed_m_s = draw.log_between(0.05, 0.6);
  const int how = draw.up_to(3);
  const double stroke_s = length_m / speed_m_s * (how == 0 ? 1 : 1.6);
  const int n = static_cast<int>(std::ceil((std::min(stroke_s, 2.0) + 0.4) * picture_hz));
  const double c = std::cos(made.heading_rad), s = std::sin(made.heading_rad);
  for (int i = 0; i <= n; ++i) {
    const double share = course(how, i / (stroke_s * picture_hz));
    const double along_m = from_m + length_m * share, across_m = beside_m + drift_m * share;
    made.hand.push_back(
        upright_pose({along_m * c - across_m * s, along_m * s + across_m * c, hand_z_m},
                     made.heading_rad + (made.turned ? std::numbers::pi / 2 : 0)));
  }
  return made;
}

/// Across the table, clone first, then the cubes, at every picture.
using Track = std::vector<std::vector<Eigen::Vector2d>>;

Track reference_track(const RandomScene& made) {
  SlidingReference reference(made.scene, made.heading_rad, made.turned, made.hand[0]);
  Track track;
  for (std::size_t i = 1; i < made.hand.size(); ++i) {
    reference.advance(made.hand[i], 1.0 / picture_hz);
    auto& seen = track.emplace_back();
    for (std::size_t j = 0; j <= made.scene.cubes.size(); ++j)
      seen.push_back(reference.position_m(j));
  }
  return track;
}

struct Tried {
  Track track;
  double turned_rad = 0;  ///< the most that any cube has
  long n_not_converged = 0;
};

Tried tried_track(const std::string& name, const RandomScene& made, int rate_hz) {
  const auto simulator = make_simulator(name);
  simulator->reset(made.scene, made.hand[0]);
  const int n = rate_hz / picture_hz;
  Tried tried;
  for (std::size_t i = 1; i < made.hand.size(); ++i) {
    for (int k = 1; k <= n; ++k)
      simulator->step(interpolate(made.hand[i - 1], made.hand[i], static_cast<double>(k) / n),
                      1.0 / rate_hz);
    const WorldState state = simulator->state();
    auto& seen = tried.track.emplace_back();
    seen.push_back(state.clone.pose.position_m.head<2>());
    for (std::size_t j = 0; j < state.cubes.size(); ++j) {
      const Pose& pose = state.cubes[j].pose;
      seen.push_back(pose.position_m.head<2>());
      const auto start = upright_pose({0, 0, 0}, made.scene.cubes[j].yaw_rad).orientation;
      tried.turned_rad =
          std::max(tried.turned_rad, rotation_vector(pose.orientation * start.conjugate()).norm());
    }
  }
  if (const auto counts = simulator->counts()) tried.n_not_converged = counts->not_converged;
  return tried;
}

double rms_mm(const Track& a, const Track& b, std::size_t body) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i][body] - b[i][body]).squaredNorm();
  return 1e3 * std::sqrt(sum / static_cast<double>(a.size()));
}

struct Found {
  unsigned seed;
  double clone_mm, cubes_end_mm, turned_deg;
};

double percentile(std::vector<double> values, double share) {
  std::ranges::sort(values);
  const auto last = static_cast<double>(values.size() - 1);
  return values[static_cast<std::size_t>(std::ceil(share * last))];
}

class RandomScenes : public testing::TestWithParam<int> {};

unsigned from_environment(const char* name, unsigned otherwise) {
  const char* text = std::getenv(name);
  return text ? static_cast<unsigned>(std::atoi(text)) : otherwise;
}

// HEFT_SCENES sets the number of scenes, HEFT_SCENE_SEED the first seed; with both, a scene can be
// run alone.
TEST_P(RandomScenes, AreTheReferences) {
  const unsigned n = from_environment("HEFT_SCENES", 60);
  const unsigned first = from_environment("HEFT_SCENE_SEED", 1);
  const char* named = std::getenv("HEFT_SIMULATOR");
  std::vector<Found> all;
  long n_not_converged = 0;
  for (unsigned seed = first; seed < first + n; ++seed) {
    const RandomScene made = random_scene(seed);
    const Track truth = reference_track(made);
    const Tried tried = tried_track(named ? named : "boxes", made, GetParam());
    n_not_converged += tried.n_not_converged;
    double cubes_mm = 0;
    for (std::size_t j = 1; j < truth[0].size(); ++j)
      cubes_mm = std::max(cubes_mm, 1e3 * (truth.back()[j] - tried.track.back()[j]).norm());
    all.push_back(
        {seed, rms_mm(truth, tried.track, 0), cubes_mm, tried.turned_rad * 180 / std::numbers::pi});
  }
  std::vector<double> clone_mm, cubes_mm, turned_deg;
  for (const Found& one : all) {
    clone_mm.push_back(one.clone_mm);
    cubes_mm.push_back(one.cubes_end_mm);
    turned_deg.push_back(one.turned_deg);
  }
  std::ranges::sort(all, std::greater{}, &Found::clone_mm);
  std::cout << n << " scenes from seed " << first << " at " << GetParam() << " Hz: clone p50 "
            << percentile(clone_mm, 0.5) << ", p95 " << percentile(clone_mm, 0.95) << ", worst "
            << all[0].clone_mm << " mm; cubes' ends p95 " << percentile(cubes_mm, 0.95)
            << ", worst " << percentile(cubes_mm, 1) << " mm; turned at most "
            << percentile(turned_deg, 1) << " degrees; " << n_not_converged << " not converged\n";
  if (std::getenv("HEFT_SCENES_WORST"))
    for (std::size_t i = 0; i < std::min<std::size_t>(25, all.size()); ++i)
      std::cout << "  seed " << all[i].seed << " " << random_scene(all[i].seed).kind << " clone "
                << all[i].clone_mm << " cubes " << all[i].cubes_end_mm << " mm turned "
                << all[i].turned_deg << '\n';
  EXPECT_LE(percentile(clone_mm, 0.95), GetParam() == 240 ? 0.03 : 0.1);
  EXPECT_LE(all[0].clone_mm, GetParam() == 240 ? 0.15 : 0.5);
}

INSTANTIATE_TEST_SUITE_P(Rates, RandomScenes, testing::Values(240, 120),
                         [](const auto& test) { return std::to_string(test.param) + "Hz"; });

// Regressions. 316: a clone that sticks to a cube that sticks to the table caused event after
// event, and came loose. 1378: mixing to negative impulses was taken as converged, and the clone
// was thrown off two cubes.
TEST(RandomScenes, SticksAndSettles) {
  for (unsigned seed : {316u, 1378u}) {
    const RandomScene made = random_scene(seed);
    EXPECT_LE(rms_mm(reference_track(made), tried_track("boxes", made, 240).track, 0), 0.02)
        << seed;
  }
}

// Checks the reference itself.
TEST(SlidingReference, IsTheClosedFormOfAPush) {
  for (unsigned seed = 0; seed < 20; seed += 5) {
    RandomScene made = random_scene(seed);
    made.heading_rad = 0;
    ASSERT_EQ(made.kind, "stroke");
    made.scene.cubes[0].yaw_rad = 0;
    made.scene.cubes[0].position_m = {0, 0, 0.0175};
    for (std::size_t i = 0; i < made.hand.size(); ++i)
      made.hand[i] = upright_pose(
          {-0.07 + 0.002 * std::min<double>(static_cast<double>(i), 40), 0, 0.0215}, 0);
    const Track truth = reference_track(made), tried = tried_track("push", made, 240).track;
    EXPECT_LE(rms_mm(truth, tried, 0), 0.01) << seed;
    EXPECT_LE(rms_mm(truth, tried, 1), 0.02) << seed;
  }
}

}  // namespace
}  // namespace heft
