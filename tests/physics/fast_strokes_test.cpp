// Quick strokes of a hand: impact, acceleration and separation within a few steps, compared with
// the closed forms of `push`.
#include <gtest/gtest.h>

#include "base/PoseTypes.h"
#include "physics/Pushes.h"

namespace heft {
namespace {

struct FastStroke {
  double mass_kg, speed_m_s;
  int rate_hz = 240;
};

void PrintTo(const FastStroke& stroke, std::ostream* out) {
  *out << stroke.mass_kg << " kg at " << stroke.speed_m_s << " m/s, " << stroke.rate_hz << " Hz";
}

constexpr double stroke_m = 0.1, before_cube_m = 0.01;

// Ends at the time of a picture, like a filmed hand.
double stroke_s(const FastStroke& stroke) {
  return std::max(1.0, std::round(stroke_m / stroke.speed_m_s * 60)) / 60;
}

Pose hand_at(const FastStroke& stroke, double t_s) {
  const double share = std::min(1.0, t_s / stroke_s(stroke));
  return upright_pose({-0.0625 - before_cube_m + share * stroke_m, 0, 0.0215}, 0);
}

struct Way {
  std::vector<double> clone_m, cube_m;
};

// At 60 Hz until the cube is at rest.
Way way_of(const std::string& simulator, const FastStroke& stroke) {
  const Scene scene = one_cube(stroke.mass_kg);
  const auto one = make_simulator(simulator);
  one->reset(scene, hand_at(stroke, 0));
  Way way;
  const int n = static_cast<int>(std::lround((stroke_s(stroke) + 0.5) * stroke.rate_hz));
  for (int i = 1; i <= n; ++i) {
    one->step(hand_at(stroke, static_cast<double>(i) / stroke.rate_hz), 1.0 / stroke.rate_hz);
    if (i % (stroke.rate_hz / 60) != 0) continue;
    const WorldState state = one->state();
    way.clone_m.push_back(state.clone.pose.position_m.x());
    way.cube_m.push_back(state.cubes[0].pose.position_m.x());
  }
  return way;
}

double rms_mm(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return 1e3 * std::sqrt(sum / static_cast<double>(a.size()));
}

class FastStrokes : public testing::TestWithParam<FastStroke> {};

TEST_P(FastStrokes, AreTheClosedFormsOnes) {
  const FastStroke stroke = GetParam();
  const Way boxes = way_of("boxes", stroke), truth = way_of("push", stroke);
  EXPECT_LE(rms_mm(boxes.clone_m, truth.clone_m), stroke.rate_hz == 240 ? 0.1 : 0.25);
  EXPECT_LE(rms_mm(boxes.cube_m, truth.cube_m), 0.6);
}

std::vector<FastStroke> fast_strokes() {
  std::vector<FastStroke> strokes;
  for (double mass_kg : {0.015, 0.03, 0.06, 0.12, 0.2, 0.3, 0.45, 0.6, 0.8})
    for (double speed_m_s : {0.05, 0.1, 0.2, 0.3, 0.5, 0.8, 1.2, 1.6, 2.0})
      for (int rate_hz : {120, 240}) strokes.push_back({mass_kg, speed_m_s, rate_hz});
  return strokes;
}

INSTANTIATE_TEST_SUITE_P(MassesAndSpeeds, FastStrokes, testing::ValuesIn(fast_strokes()));

// Pressed against a cube that does not move, then moved along its face: it sticks, slips and slides
// off as in small steps.
TEST(PressedClone, SlipsWhenFrictionGives) {
  const Scene scene = one_cube(1000);
  const auto hand = [](double t_s) {
    const double press_m = std::min(t_s / 0.4, 1.0) * 0.032;
    const double draw_m = std::clamp((t_s - 0.4) / 1.2, 0.0, 1.0) * 0.08;
    return upright_pose({-0.0745 + press_m, draw_m, 0.021}, 0);
  };
  const auto way_m = [&](int rate_hz) {
    std::vector<Eigen::Vector3d> seen_m;
    int n = 0;
    run(*make_simulator("boxes"), scene, hand, 2, rate_hz,
        [&](double, const Pose&, const WorldState& state) {
          if (++n % (rate_hz / 60) == 0) seen_m.push_back(state.clone.pose.position_m);
        });
    return seen_m;
  };
  const auto truth_m = way_m(7680);
  for (const int rate_hz : {60, 120, 240}) {
    const auto tried_m = way_m(rate_hz);
    ASSERT_EQ(tried_m.size(), truth_m.size());
    for (std::size_t i = 0; i < truth_m.size(); ++i)
      EXPECT_LE((tried_m[i] - truth_m[i]).norm(), 0.1e-3) << rate_hz << " Hz, picture " << i;
  }
}

// Distance v^2 / (2 mu g), whatever pushed the cube before.
TEST(SlidingCube, StopsWhereFrictionStopsIt) {
  for (const double speed_m_s : {0.1, 0.5, 1.0, 2.0})
    for (const int rate_hz : {60, 240, 960}) {
      Scene scene = one_cube(0.2);
      scene.coupling.decoupled = false;
      const double stroke_s = std::round(0.2 / speed_m_s * 60) / 60, way_m = speed_m_s * stroke_s;
      const auto hand = [&](double t_s) {
        return upright_pose({-0.1 + std::min(t_s * speed_m_s, way_m), 0, 0.0215}, 0);
      };
      const WorldState state = run(*make_simulator("boxes"), scene, hand, stroke_s + 1.5, rate_hz);
      const double stops_m = -0.1 + way_m + 0.0625 + speed_m_s * speed_m_s / (2 * 0.8 * 9.81);
      EXPECT_NEAR(state.cubes[0].pose.position_m.x(), stops_m, 0.2e-3)
          << speed_m_s << " m/s, " << rate_hz << " Hz";
    }
}

}  // namespace
}  // namespace heft
