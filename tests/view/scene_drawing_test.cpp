// The drawn scene: depth order, shadows, backgrounds, and objects under a touch.
#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <limits>

#include "base/Error.h"
#include "base/PoseTypes.h"
#include "base/Random.h"
#include "view/Scenes.h"

namespace heft {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Optional;
using namespace heft::test;

constexpr Bgr picture_gray{200, 200, 200};

bool bluer(const Bgr& a, const Bgr& b) {
  return a.blue - a.red > b.blue - b.red + 100;
}

class OverFilm : public testing::Test {
 protected:
  const ViewSetup setup = setup_with(Intrinsics{});
  SceneDrawing drawing{setup};
  ViewFrame shown = three_cubes(setup);

  // Middle of a cube's top in the picture.
  Eigen::Vector2d top_of(int slot) const {
    const Eigen::Vector3d half_m(0, 0, setup.stage.cube_size_m / 2);
    const auto& cube = shown.frame.cubes[static_cast<std::size_t>(slot - 1)];
    return project(*setup.camera, camera_looking_down(55 * M_PI / 180) *
                                      Eigen::Vector3d(cube.position_m + half_m));
  }
};

TEST_F(OverFilm, PictureIsUnchangedWhereNothingIsDrawn) {
  RandomStream draws(1, "picture");
  auto picture = gray_picture(*setup.camera);
  for (std::uint8_t& value : picture->pixels) value = static_cast<std::uint8_t>(draws.below(256));
  shown.camera = picture;
  shown.frame.cubes.clear();
  EXPECT_EQ(drawing.draw(shown).pixels, picture->pixels);
}

// A hand in front of a cube hides it and receives no shade; the clone is visible over both.
TEST_F(OverFilm, MaskHidesCubesButNotTheClone) {
  shown.frame.clone = pointing_away(0, 0.02, 0.06);
  const Eigen::Vector2d left = top_of(1), middle = top_of(2), right = top_of(3);
  const Bgr clone_over_cube = at(drawing.draw(shown), middle),
            cube = at(drawing.draw(shown), right);
  auto mask = std::make_shared<Image>(setup.camera->width_px, setup.camera->height_px, 1);
  for (int y = 0; y < mask->height; ++y)
    for (int x = 0; x < mask->width / 2 + 60; ++x)
      mask->pixels[static_cast<std::size_t>(y * mask->width + x)] = 255;
  shown.in_front = mask;
  const Image& drawn = drawing.draw(shown);
  EXPECT_EQ(at(drawn, left), picture_gray);
  EXPECT_EQ(at(drawn, right), cube) << "beside the mask";
  EXPECT_TRUE(bluer(at(drawn, middle), picture_gray));
  EXPECT_NE(at(drawn, middle), clone_over_cube) << "no cube shines through";
  for (int x = 0; x < 300; x += 7)
    EXPECT_EQ(at(drawn, x, 240), picture_gray) << "no shade at " << x;
}

TEST_F(OverFilm, GrayPictureEqualsItsColorVersion) {
  const Image in_color = drawing.draw(shown);
  shown.camera = gray_picture(*setup.camera, 1);
  EXPECT_EQ(drawing.draw(shown).pixels, in_color.pixels);
}

TEST_F(OverFilm, NothingIsDrawnFarFromTheObjects) {
  const Image& drawn = drawing.draw(shown);
  for (int y = 0; y < drawn.height; ++y) {
    for (int x = 0; x < drawn.width; ++x) {
      double nearest_px = 1e9;
      for (int slot : {1, 2, 3})
        nearest_px = std::min(nearest_px, (top_of(slot) - Eigen::Vector2d(x, y)).norm());
      ASSERT_TRUE(nearest_px < 85 || at(drawn, x, y) == picture_gray) << x << " " << y;
    }
  }
}

TEST_F(OverFilm, CubesLookTheSameInEverySlot) {
  const Image in_order = drawing.draw(shown);
  std::ranges::reverse(shown.frame.cubes);
  EXPECT_EQ(drawing.draw(shown).pixels, in_order.pixels);
}

TEST_F(OverFilm, CloneHidesCubeOnlyIfInFront) {
  const Eigen::Vector2d top = top_of(2);
  const Bgr cube = at(drawing.draw(shown), top);
  shown.frame.clone = pointing_away(0, 0, 0.075);
  const Bgr in_front = at(drawing.draw(shown), top);
  EXPECT_TRUE(bluer(in_front, cube));
  shown.frame.clone = pointing_away(0, 0.085);
  EXPECT_EQ(at(drawing.draw(shown), top), cube);
  // Through the side of the cube, it is below the top.
  shown.frame.clone = upright_pose(shown.frame.cubes[1].position_m, 0);
  shown.frame.clone->position_m.z() -= 0.01;
  EXPECT_EQ(at(drawing.draw(shown), top), cube);
}

// 28 % of the picture remains visible behind it, dimmed by its shadow by up to 30 %.
TEST_F(OverFilm, CloneIsTranslucent) {
  shown.frame.cubes.clear();
  shown.frame.clone = pointing_away(0, 0);
  const Bgr over_light = at(drawing.draw(shown), 320, 235);
  shown.camera = gray_picture(*setup.camera, 3, 0);
  const Bgr over_black = at(drawing.draw(shown), 320, 235);
  EXPECT_TRUE(bluer(over_light, picture_gray));
  EXPECT_TRUE(bluer(over_black, {0, 0, 0}));
  for (int more : {over_light.red - over_black.red, over_light.blue - over_black.blue}) {
    EXPECT_LE(more, 0.28 * 200 + 2);
    EXPECT_GE(more, 0.28 * 200 * 0.7 - 2);
  }
}

TEST_F(OverFilm, TableHidesObjectsBelowIt) {
  shown.frame.cubes = {upright_pose({0, 0, -0.03}, 0.2)};
  EXPECT_EQ(drawing.draw(shown).pixels, shown.camera->pixels);
  // A half sunk cube is visible only above the table.
  shown.frame.cubes = {upright_pose({0, 0, 0}, 0)};
  const double half_m = setup.stage.cube_size_m / 2;
  const Pose camera = camera_looking_down(55 * M_PI / 180);
  const auto foot = project(*setup.camera, camera * Eigen::Vector3d(0, -half_m, 0));
  const Image& drawn = drawing.draw(shown);
  const Bgr above = at(drawn, Eigen::Vector2d(foot.x(), foot.y() - 3));
  const Bgr below = at(drawn, Eigen::Vector2d(foot.x(), foot.y() + 2));
  EXPECT_GT(above.red - above.blue, 60);
  EXPECT_EQ(below.red, below.blue);
}

TEST_F(OverFilm, ShadowFadesAsCubeRises) {
  const Eigen::Vector2d beside = project(
      *setup.camera, camera_looking_down(55 * M_PI / 180) * Eigen::Vector3d(0.085, 0.02, 0));
  const auto gray_beside = [&](double rise_m) {
    ViewFrame one = shown;
    one.frame.cubes = {upright_pose({0.06, 0.02, 0.0175 + rise_m}, 0)};
    const Bgr bgr = at(drawing.draw(one), beside);
    EXPECT_EQ(bgr.blue, bgr.red);
    EXPECT_EQ(bgr.green, bgr.red);
    return bgr.red;
  };
  EXPECT_LT(gray_beside(0), 190);
  EXPECT_GT(gray_beside(0), 60);
  EXPECT_GT(gray_beside(0.06), gray_beside(0));
  EXPECT_LE(gray_beside(0.06), 200);
}

TEST_F(OverFilm, SlotIsFoundUnderAndNearATouch) {
  drawing.draw(shown);
  for (int slot : {1, 2, 3}) {
    const auto top = top_of(slot);
    EXPECT_THAT(drawing.slot_at(top.x(), top.y()), Optional(slot));
    EXPECT_THAT(drawing.slot_at(top.x(), top.y() - 26), Optional(slot));  // 10 px above its top
    EXPECT_EQ(drawing.slot_at(top.x(), top.y() - 34), std::nullopt);
  }
  EXPECT_EQ(drawing.slot_at(-1e9, 5), std::nullopt);
}

TEST_F(OverFilm, TouchOnCloneFindsCubeBehindIt) {
  shown.frame.clone = pointing_away(0, 0, 0.075);
  drawing.draw(shown);
  EXPECT_THAT(drawing.slot_at(top_of(2).x(), top_of(2).y()), Optional(2));
}

TEST_F(OverFilm, LabelsAreAboveVisibleCubes) {
  shown.frame.cubes[2].position_m.x() = 0.4;
  drawing.draw(shown);
  for (int slot : {1, 2}) {
    const auto place = drawing.label_place(slot);
    ASSERT_TRUE(place);
    EXPECT_NEAR(place->x(), top_of(slot).x(), 5);
    EXPECT_LT(place->y(), top_of(slot).y() - 5);
    EXPECT_GT(place->y(), top_of(slot).y() - 40);
  }
  EXPECT_EQ(drawing.label_place(3), std::nullopt);
  EXPECT_EQ(drawing.label_place(4), std::nullopt);
  EXPECT_EQ(drawing.label_place(0), std::nullopt);
}

TEST_F(OverFilm, LastCameraPoseIsKeptUntilTheNext) {
  shown.camera_from_board = camera_looking_down(1.2, 0.35);
  const Image there = drawing.draw(shown);
  shown.camera_from_board.reset();
  EXPECT_EQ(drawing.draw(shown).pixels, there.pixels);
}

TEST_F(OverFilm, PictureOfOtherSizeThanCalibrationIsRefused) {
  shown.camera = std::make_shared<Image>(1280, 720, 3);
  try {
    drawing.draw(shown);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("1280 x 720"), HasSubstr("640 x 480")));
  }
  shown.camera = std::make_shared<Image>(640, 480, 4);
  EXPECT_THROW(drawing.draw(shown), Error);
}

TEST(WithoutACamera, TableAndTrackedEffectorAreDrawn) {
  const ViewSetup setup = setup_with(std::nullopt);
  SceneDrawing drawing(setup);
  ViewFrame shown;
  shown.frame.tracked = false;
  const Image table = drawing.draw(shown);
  EXPECT_EQ(table.width, 640);
  EXPECT_EQ(table.height, 480);
  shown.frame.tracked = true;
  shown.frame.effector = pointing_away(0, 0);
  const Bgr effector = at(drawing.draw(shown), 320, 230);
  EXPECT_NE(effector, at(table, 320, 230));
  EXPECT_LT(std::abs(effector.red - effector.blue), 25);  // gray
  shown.frame.clone = shown.frame.effector;
  EXPECT_TRUE(bluer(at(drawing.draw(shown), 320, 230), effector));
  shown = {};
  shown.frame.tracked = false;
  EXPECT_EQ(drawing.draw(shown).pixels, table.pixels);
  shown.camera_from_board = camera_looking_down(1.2, 0.3);
  EXPECT_NE(drawing.draw(shown).pixels, table.pixels);
}

// A random pose, sometimes not a number or far away.
Pose any_pose(RandomStream& draws, double reach_m) {
  const auto draw = [&] { return 2 * draws.uniform() - 1; };
  Pose pose{reach_m * Eigen::Vector3d(draw(), draw(), draw()),
            Eigen::Quaterniond(draw(), draw(), draw(), draw()).normalized()};
  if (draws.below(9) == 0) pose.position_m.x() = std::numeric_limits<double>::quiet_NaN();
  if (draws.below(9) == 0) pose.position_m.y() *= 1e9;
  return pose;
}

ViewFrame any_picture(RandomStream draws) {
  ViewFrame shown;
  shown.camera_from_board = any_pose(draws, 0.3);
  for (int i = 0; i < 3; ++i) shown.frame.cubes.push_back(any_pose(draws, 0.15));
  shown.frame.effector = any_pose(draws, 0.15);
  if (draws.coin(0.8)) shown.frame.clone = any_pose(draws, 0.15);
  return shown;
}

// The camera may be inside or behind a cube or have no valid pose, and no frame affects a later
// one.
RC_GTEST_PROP(AnyScene, IsDrawnIndependentlyOfTheLastFrame, (std::uint64_t seed)) {
  const ViewSetup setup = setup_with(strong_lens());
  SceneDrawing used(setup), fresh(setup);
  used.draw(any_picture(RandomStream(seed, "before")));
  const ViewFrame shown = any_picture(RandomStream(seed, "after"));
  RC_ASSERT(used.draw(shown).pixels == fresh.draw(shown).pixels);
  used.slot_at(320, 240);
  for (int slot : {1, 2, 3}) used.label_place(slot);
}

}  // namespace
}  // namespace heft
