// A second print of the effector's tags on the table is not taken for the effector.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>

#include "tracking/Scenes.h"
#include "tracking/Tracker.h"

namespace heft {
namespace {

constexpr std::uint64_t seed = 20261126;
constexpr int n_pictures = 60;
constexpr double stray_m = 0.032;  // as large as the effector's own

// The table with tags of the effector in place of some of the board's, as if a net lay on it.
Apparatus with_stray_net(const Apparatus& apparatus) {
  constexpr std::array<std::size_t, 5> places{0, 1, 6, 7, 12};  // in the two leftmost columns
  Apparatus filmed = apparatus;
  for (std::size_t i = 0; i < places.size(); ++i) {
    Tag& tag = filmed.board.tags[places[i]];
    tag.id = apparatus.effector.tags[i].id;
    const Eigen::Vector3d center_m = (tag.corners_m[0] + tag.corners_m[2]) / 2;
    for (Eigen::Vector3d& corner_m : tag.corners_m)
      corner_m = center_m + stray_m / 0.040 * (corner_m - center_m);
  }
  return filmed;
}

struct Found {
  int n = 0, n_false = 0, n_foreign = 0;
};

Found found(const Apparatus& filmed, const Apparatus& apparatus, bool with_effector) {
  Found sum;
  RandomStream random(seed, "stray prints", 0);
  SyntheticCamera camera(filmed, SyntheticSettings(), seed);
  for (int i = 0; i < n_pictures; ++i) {
    const Pose pose = random_held_pose(random);
    Tracker tracker(apparatus);
    const TrackedPicture seen = tracker.track(
        camera.picture([&](double) { return with_effector ? std::optional(pose) : std::nullopt; },
                       0, static_cast<std::uint64_t>(i)),
        0);
    sum.n_foreign += seen.n_foreign_tags > 0;
    if (!seen.board_from_effector) continue;
    ++sum.n;
    const Eigen::Vector3d tip_m(0.045, 0, 0);
    sum.n_false +=
        !with_effector || (*seen.board_from_effector * tip_m - pose * tip_m).norm() > 0.005;
  }
  return sum;
}

TEST(StrayPrints, AreNeverTakenForTheEffector) {
  const Apparatus apparatus = default_apparatus(640);
  const Apparatus filmed = with_stray_net(apparatus);
  const Found clean = found(apparatus, apparatus, true), stray = found(filmed, apparatus, true);
  EXPECT_EQ(clean.n_foreign, 0);
  EXPECT_GE(stray.n_foreign, n_pictures / 2);
  EXPECT_EQ(stray.n_false, clean.n_false) << "seed " << seed;
  EXPECT_GE(stray.n, 0.95 * clean.n) << "seed " << seed;
}

TEST(StrayPrints, AloneAreNoEffector) {
  const Apparatus apparatus = default_apparatus(640);
  const Found alone = found(with_stray_net(apparatus), apparatus, false);
  EXPECT_EQ(alone.n, 0);
  EXPECT_EQ(alone.n_foreign, n_pictures);
}

// The first picture in which a stray print is noticed that came into view after the fifth one,
// while board and effector are followed; none of 70 otherwise.
std::optional<int> noticed(const Apparatus& filmed, const Apparatus& apparatus) {
  constexpr int n_before = 5, n_followed = 70;
  Tracker tracker(apparatus);
  RandomStream random(seed, "followed", 0);
  const Pose pose = random_held_pose(random);
  const auto held = [&](double t_s) {
    return std::optional(
        Pose{pose.position_m + Eigen::Vector3d(0.03 * std::sin(t_s), 0, 0), pose.orientation});
  };
  SyntheticSettings settings;
  settings.hand = false;
  SyntheticCamera before(apparatus, settings, seed), then(filmed, settings, seed);
  for (int i = 0; i < n_followed; ++i) {
    SyntheticCamera& camera = i < n_before ? before : then;
    const double t_s = i / 15.0;
    const TrackedPicture seen =
        tracker.track(camera.picture(held, t_s, static_cast<std::uint64_t>(i)), t_s);
    EXPECT_TRUE(seen.board_from_effector) << i;
    if (seen.n_foreign_tags > 0) return i;
  }
  return std::nullopt;
}

TEST(StrayPrints, AreNoticedWhileBodiesAreFollowed) {
  const Apparatus apparatus = default_apparatus(640);
  EXPECT_EQ(noticed(apparatus, apparatus), std::nullopt);
  EXPECT_TRUE(noticed(with_stray_net(apparatus), apparatus));
  // A second print of one of the board's tags, instead of another one of its tags.
  Apparatus filmed = apparatus;
  filmed.board.tags[0].id = filmed.board.tags[20].id;
  EXPECT_TRUE(noticed(filmed, apparatus));
}

}  // namespace
}  // namespace heft
