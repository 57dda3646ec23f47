// Pushes in the log, against the displayed frames.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "replay/StoredSession.h"

namespace heft {
namespace {

struct Pushes {
  double peak_lag_m = 0, deepest_m = 0;
};

Pushes logged_pushes(const std::vector<CubeRow>& cubes, int attempt_index) {
  Pushes most;
  for (const CubeRow& cube : cubes) {
    EXPECT_EQ(cube.n_pushes > 0, cube.peak_lag_m && cube.max_push_displacement_m);
    if (cube.attempt_index != attempt_index) continue;
    most.peak_lag_m = std::max(most.peak_lag_m, cube.peak_lag_m.value_or(0));
    most.deepest_m = std::max(most.deepest_m, cube.max_push_displacement_m.value_or(0));
  }
  return most;
}

// The largest lag while a cube is touched, and the extent of the effector's positions during the
// touch.
Pushes shown(const std::vector<FrameRow>& frames) {
  Pushes most;
  std::vector<Eigen::Vector3d> places_m;
  for (const FrameRow& frame : frames) {
    if (!frame.contact_slot) continue;
    const Eigen::Vector3d& place_m = frame.effector.position_m;
    most.peak_lag_m = std::max(most.peak_lag_m, (frame.clone->position_m - place_m).norm());
    for (const Eigen::Vector3d& other_m : places_m)
      most.deepest_m = std::max(most.deepest_m, (place_m - other_m).norm());
    places_m.push_back(place_m);
  }
  return most;
}

TEST(Pushes, AreReportedAsTheyWereShown) {
  const testing::StoredSession stored(testing::shipped_protocol("quick"), "simulated", 3);
  const auto cubes = stored.reader().cubes(stored.id());
  int n_coupled = 0, n_decoupled = 0;
  for (const TrialRow& trial : stored.reader().trials(stored.id())) {
    if (trial.plan.task == "introduction") continue;  // newly shuffled cubes begin anew
    const auto frames = stored.reader().frames(stored.id(), trial.attempt_index);
    const Pushes in_log = logged_pushes(cubes, trial.attempt_index), on_screen = shown(frames);
    EXPECT_EQ(in_log.peak_lag_m, on_screen.peak_lag_m);
    EXPECT_GT(in_log.deepest_m, 0.01);
    EXPECT_LE(in_log.deepest_m, on_screen.deepest_m);
    const bool is_coupled = trial.plan.condition == "C1";
    if (is_coupled) {
      EXPECT_LT(in_log.peak_lag_m, 1e-9);
    } else {
      EXPECT_GT(in_log.peak_lag_m, 1e-3);
    }
    ++(is_coupled ? n_coupled : n_decoupled);
  }
  EXPECT_GT(n_coupled, 0);
  EXPECT_GT(n_decoupled, 0);
}

}  // namespace
}  // namespace heft
