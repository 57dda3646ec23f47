// Lags of pushes and paths of cubes, from frames made by hand and from a replayed session.
#include <gmock/gmock.h>

#include "base/PoseTypes.h"
#include "replay/StoredSession.h"
#include "replay/VisibleCues.h"
#include "replay/WhatIf.h"

namespace heft {
namespace {
using testing::shipped_protocol;
using testing::StoredSession;

// A frame in which the effector pushes a cube along y, with the clone lag_m behind it.
DisplayedFrame pushing(double t_s, double effector_y_m, double lag_m, double cube_y_m) {
  DisplayedFrame frame;
  frame.t_s = t_s;
  frame.effector = upright_pose({0, effector_y_m, 0.02}, 0);
  frame.clone = upright_pose({0, effector_y_m - lag_m, 0.02}, 0);
  frame.cubes = {upright_pose({0, cube_y_m, 0.0175}, 0), upright_pose({0.1, 0, 0.0175}, 0)};
  return frame;
}

TEST(VisibleCues, APushHasItsLargestLagAndItsCubeAPath) {
  CuesByMass cues;
  {
    CueMeter meter(cues);
    const std::vector<double> masses_g{200, 15};
    for (int i = 0; i < 10; ++i) {
      const double y_m = 0.01 * i;
      meter.add(pushing(0.1 * i, y_m, i == 5 ? 0.03 : 0.02, y_m),
                i > 0 ? std::optional(1) : std::nullopt, masses_g);
    }
    // Back without touching, then again.
    meter.add(pushing(2, 0, 0, 0.09), std::nullopt, masses_g);
    meter.add(pushing(3, 0.08, 0, 0.09), 1, masses_g);
    meter.add(pushing(3.1, 0.10, 0.01, 0.10), 1, masses_g);
  }
  ASSERT_EQ(cues.size(), 1u) << "the other cube was not pushed";
  const VisibleCues& found = cues.at(200);
  EXPECT_EQ(found.n_pushes, 2);
  EXPECT_NEAR(found.mean_lag_m(), 0.02, 1e-12);
  EXPECT_NEAR(found.largest_lag_m, 0.03, 1e-12);
  EXPECT_EQ(found.n_cubes, 1);
  EXPECT_NEAR(found.mean_path_m(), 0.10, 1e-12);
  EXPECT_NEAR(found.mean_end_m(), 0.10, 1e-12);
}

// An answer that shuffles or replaces the cubes puts them back in their places immediately.
TEST(VisibleCues, OfCubesWithNewMassesAreTheirOwn) {
  CuesByMass cues;
  {
    CueMeter meter(cues);
    for (int i = 0; i < 10; ++i)
      meter.add(pushing(0.1 * i, 0.01 * i, 0.03, 0.01 * i), 1, {200, 15});
    for (int i = 0; i < 10; ++i)
      meter.add(pushing(1 + 0.1 * i, 0.01 * i, 0.02, 0.01 * i), 1, {150, 15});
  }
  ASSERT_TRUE(cues.contains(200) && cues.contains(150));
  for (const auto& [mass_g, lag_m] : {std::pair(200.0, 0.03), std::pair(150.0, 0.02)}) {
    EXPECT_EQ(cues.at(mass_g).n_pushes, 1) << mass_g;
    EXPECT_NEAR(cues.at(mass_g).mean_lag_m(), lag_m, 1e-12);
    EXPECT_NEAR(cues.at(mass_g).mean_path_m(), 0.09, 1e-12);
  }
}

TEST(VisibleCues, AShortGapIsTheSamePushAndAnotherCubeAnotherOne) {
  CuesByMass cues;
  {
    CueMeter meter(cues);
    const std::vector<double> masses_g{200, 15};
    meter.add(pushing(0, 0, 0, 0), 1, masses_g);
    meter.add(pushing(0.1, 0.01, 0, 0), std::nullopt, masses_g);
    meter.add(pushing(0.19, 0.02, 0, 0), 1, masses_g);
    meter.add(pushing(0.3, 0.03, 0, 0), 2, masses_g);
  }
  EXPECT_EQ(cues.at(200).n_pushes, 1);
  EXPECT_EQ(cues.at(15).n_pushes, 1);
}

TEST(VisibleCues, ACubePutBackHasNotGoneThere) {
  CuesByMass cues;
  {
    CueMeter meter(cues);
    meter.add(pushing(0, 0, 0, 0), 1, {200, 15});
    meter.add(pushing(0.1, 0.05, 0, 0.05), 1, {200, 15});
    meter.add(pushing(0.2, 0.05, 0, 0), std::nullopt, {200, 15});
  }
  EXPECT_NEAR(cues.at(200).mean_path_m(), 0.05, 1e-12);
  EXPECT_NEAR(cues.at(200).mean_end_m(), 0, 1e-12);
}

// The lag is μ m g / k: twice the stiffness gives half the lag, and twice the grams per meter.
TEST(VisibleCues, AWhatIfShowsLagsBeforeAndAfter) {
  const StoredSession stored(shipped_protocol("quick"), "simulated", 5);
  const auto header = stored.session().row.header;
  const Protocol stiffer =
      parse_protocol(header.protocol_text, header.protocol_name,
                     std::vector<ProtocolSetting>{{"coupling.stiffness_n_per_m", "100"}});
  bool compared = false;
  for (const PathDifference& kind : compare_paths(stored.reader(), stored.session(), stiffer))
    for (const CueDifference& cube : kind.cues) {
      if (kind.condition == "C1") {
        EXPECT_LT(cube.would_be.largest_lag_m, 1e-9);
        EXPECT_FALSE(kind.logged_g_per_m);
      }
      if (kind.task != "sorting" || kind.condition != "C2" || cube.mass_g != 200) continue;
      compared = true;
      EXPECT_EQ(cube.logged.n_pushes, 2);
      EXPECT_NEAR(cube.would_be.mean_lag_m(), cube.logged.mean_lag_m() / 2,
                  0.15 * cube.logged.mean_lag_m());
      EXPECT_NEAR(*kind.would_be_g_per_m, 2 * *kind.logged_g_per_m, 1e-6);
      EXPECT_GT(cube.would_be.mean_path_m(), cube.logged.mean_path_m());
    }
  EXPECT_TRUE(compared);
}

TEST(VisibleCues, TheSameWorldIsNoticedTheSame) {
  const StoredSession stored(shipped_protocol("quick"), "simulated", 5);
  for (const PathDifference& kind :
       compare_paths(stored.reader(), stored.session(), *stored.session().protocol))
    for (const CueDifference& cube : kind.cues) {
      EXPECT_EQ(cube.logged.n_pushes, cube.would_be.n_pushes);
      EXPECT_EQ(cube.logged.lag_m, cube.would_be.lag_m);
      EXPECT_EQ(cube.logged.path_m, cube.would_be.path_m);
      EXPECT_EQ(cube.logged.end_m, cube.would_be.end_m);
    }
}

}  // namespace
}  // namespace heft
