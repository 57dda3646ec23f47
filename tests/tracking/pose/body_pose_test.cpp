// Poses from exactly known edges.
#include <gtest/gtest.h>

#include <cmath>

#include "tracking/Scenes.h"
#include "tracking/detection/PlanarPose.h"
#include "tracking/pose/BodyPose.h"

namespace heft {
namespace {

const Intrinsics camera_640 = default_camera(640, 480);
const Pose from_board = SyntheticSettings().camera_from_board;

// A tag's exact edges, moved outwards by bias_px.
MeasuredTag exact(const Tag& tag, const Pose& pose, double bias_px = 0) {
  std::array<Eigen::Vector2d, 4> corners;
  for (std::size_t i = 0; i < 4; ++i) corners[i] = project(camera_640, pose * tag.corners_m[i]);
  MeasuredTag seen = unrefined_tag(corners);
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d middle = (tag.corners_m[i] + tag.corners_m[(i + 1) % 4]) / 2;
    const Eigen::Vector2d along = (corners[(i + 1) % 4] - corners[i]).normalized();
    const Eigen::Vector2d outwards = bias_px * Eigen::Vector2d(along.y(), -along.x());
    seen.edges[i].points_px = {corners[i] + outwards,
                               project(camera_640, pose * middle) + outwards};
    seen.edges[i].sd_px = 0.02;
  }
  return seen;
}

std::vector<TagObservation> observations(const MarkerBody& body, const Pose& pose,
                                         double bias_px = 0) {
  std::vector<TagObservation> tags;
  for (const Tag& tag : body.tags) {
    const MeasuredTag seen = exact(tag, pose, bias_px);
    const Eigen::Vector2d a = seen.corners_px[1] - seen.corners_px[0],
                          b = seen.corners_px[3] - seen.corners_px[0];
    if (a.x() * b.y() - a.y() * b.x() > 50) tags.push_back(observe(camera_640, tag, seen, true));
  }
  return tags;
}

void expect_near(const Pose& a, const Pose& b, double m, double rad) {
  EXPECT_LT((a.position_m - b.position_m).norm(), m);
  EXPECT_LT(a.orientation.angularDistance(b.orientation), rad);
}

TEST(PlanarPose, ItsFirstPoseIsTheTrueOneWhereverTheTagIs) {
  RandomStream random(1, "poses");
  const MarkerBody effector = box_effector(0.032);
  for (int i = 0; i < 100; ++i) {
    const Pose held = random_held_pose(random);
    const Pose pose{from_board * held.position_m, from_board.orientation * held.orientation};
    std::array<Eigen::Vector2d, 4> rays;
    for (std::size_t c = 0; c < 4; ++c)
      rays[c] = (pose * effector.tags[1].corners_m[c]).hnormalized();
    const auto poses = planar_poses(effector.tags[1].corners_m, rays);
    ASSERT_FALSE(poses.empty());
    expect_near(poses[0], pose, 1e-6, 1e-5);
  }
}

TEST(PlanarPose, NoneForCornersInALine) {
  const std::array<Eigen::Vector2d, 4> line{{{0, 0}, {.1, 0}, {.2, 0}, {.3, 0}}};
  for (const Pose& pose : planar_poses(grid_board(1, 1, .04, .05).tags[0].corners_m, line))
    EXPECT_TRUE(pose.position_m.allFinite());
}

TEST(BodyPose, IsExactForExactEdges) {
  RandomStream random(2, "poses");
  const MarkerBody effector = box_effector(0.032);
  for (int i = 0; i < 50; ++i) {
    const Pose held = random_held_pose(random);
    const Pose pose{from_board * held.position_m, from_board.orientation * held.orientation};
    const auto fit = solve_body(observations(effector, pose), std::nullopt, {0, 0});
    ASSERT_TRUE(fit);
    expect_near(fit->camera_from_body, pose, 2e-6, 2e-5);
    EXPECT_LT(fit->rms_px, 1e-3);
  }
}

TEST(BodyPose, DistinguishesBiasFromDistanceOnABoard) {
  const MarkerBody board = grid_board(6, 4, .040, .048);
  const auto fit = solve_body(observations(board, from_board, -0.28), std::nullopt, {0, 0.5});
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->bias_px, -0.28, 0.002);
  expect_near(fit->camera_from_body, from_board, 2e-5, 1e-4);
}

TEST(BodyPose, WithoutTheBiasTheBoardSeemsFurtherAway) {
  const MarkerBody board = grid_board(1, 1, .040, .048);
  const auto fit = solve_body(observations(board, from_board, -0.28), std::nullopt, {0, 0});
  ASSERT_TRUE(fit);
  EXPECT_GT(fit->camera_from_body.position_m.z(), from_board.position_m.z() + 0.003);
}

TEST(BodyPose, LeavesOutATagThatWasReadWrongly) {
  const MarkerBody board = grid_board(6, 4, .040, .048);
  auto tags = observations(board, from_board);
  const auto other = observe(camera_640, board.tags[3], exact(board.tags[9], from_board), true);
  tags[3] = other;
  const auto fit = solve_body(tags, std::nullopt, {0, 0.1});
  ASSERT_TRUE(fit);
  EXPECT_EQ(fit->n_tags, 23);
  expect_near(fit->camera_from_body, from_board, 2e-5, 1e-4);
}

TEST(BodyPose, WhereThePictureCanNotDecideTheExpectedPoseDoes) {
  // A small tag far away, slightly turned, and its mirror image.
  const MarkerBody tag = grid_board(1, 1, .012, .012);
  const Eigen::Quaterniond facing(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()));
  const Pose near{{0, 0, 0.8}, Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY()) * facing};
  const Pose mirrored{{0, 0, 0.8}, Eigen::AngleAxisd(-0.3, Eigen::Vector3d::UnitY()) * facing};
  for (const Pose& expected : {near, mirrored}) {
    const auto fit = solve_body(observations(tag, near), expected, {0, 0});
    ASSERT_TRUE(fit);
    EXPECT_TRUE(fit->ambiguous);
    EXPECT_LE(fit->quality, 0.5);
    EXPECT_LT(fit->camera_from_body.orientation.angularDistance(expected.orientation), 0.1);
  }
}

// The top face's tag alone, slightly tilted: its mirror image is so near that both form one flat
// minimum.
TEST(BodyPose, TwoTiltsThatLookAlikeLowerTheQuality) {
  MarkerBody top = box_effector(0.032);
  top.tags = {top.tags[1]};
  const Eigen::Quaterniond facing(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()));
  const auto tilted = [&](double rad) {
    const Pose pose{{0, 0, 0.45}, Eigen::AngleAxisd(rad, Eigen::Vector3d::UnitY()) * facing};
    const auto fit = solve_body(observations(top, pose), pose, {0, 0});
    EXPECT_TRUE(fit);
    return fit.value_or(BodyFit{});
  };
  const BodyFit little = tilted(0.03), much = tilted(0.6);
  EXPECT_FALSE(little.ambiguous);
  EXPECT_LT(little.quality, 0.8 * much.quality);
}

TEST(BodyPose, WithoutAnExpectedPoseOneOfTwoThatFitIsNoPose) {
  const MarkerBody tag = grid_board(1, 1, .040, .040);
  const Eigen::Quaterniond facing(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()));
  const Pose pose{{0, 0, 2.5}, Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY()) * facing};
  const auto unknown = solve_body(observations(tag, pose), std::nullopt, {0, 0});
  const auto known = solve_body(observations(tag, pose), pose, {0, 0});
  ASSERT_TRUE(unknown && known);
  EXPECT_TRUE(unknown->ambiguous);
  EXPECT_GT(std::sqrt(unknown->spread_m2), 0.005);
  EXPECT_LT(std::sqrt(known->spread_m2), 0.002);
}

TEST(BodyPose, NoTagsNoPose) {
  EXPECT_FALSE(solve_body({}, from_board, {0, 0}));
}

TEST(BodyPose, TagsThatFitNoPoseGiveNone) {
  const MarkerBody board = grid_board(1, 1, .040, .048);
  MeasuredTag crossed = unrefined_tag({Eigen::Vector2d(100, 100), Eigen::Vector2d(300, 300),
                                       Eigen::Vector2d(300, 100), Eigen::Vector2d(100, 300)});
  EXPECT_FALSE(
      solve_body({observe(camera_640, board.tags[0], crossed, true)}, std::nullopt, {0, 0}));
}

TEST(BodyPose, AWhiteBorderWithinBlackIsMovedTheOtherWay) {
  const MarkerBody board = grid_board(6, 4, .040, .048);
  std::vector<TagObservation> tags;
  for (const Tag& tag : board.tags)
    tags.push_back(observe(camera_640, tag, exact(tag, from_board, 0.28), false));
  const auto fit = solve_body(tags, std::nullopt, {0, 0.5});
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->bias_px, -0.28, 0.002);
}

}  // namespace
}  // namespace heft
