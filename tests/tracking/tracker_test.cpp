// Tracking on pictures of the synthetic camera, whose true poses are known.
#include "tracking/Tracker.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "base/Error.h"
#include "base/PoseTypes.h"
#include "tracking/Scenes.h"

namespace heft {
namespace {

using testing::HasSubstr;

const Eigen::Vector3d tip_m(0.045, 0, 0);
constexpr double degrees = 180 / M_PI;

struct Errors {
  std::vector<double> board_mm, board_deg, tip_mm, effector_deg;
  int n_pictures = 0;

  static double p95(std::vector<double> values) {
    std::ranges::sort(values);
    return values.at(values.size() * 95 / 100);
  }
};

// The held effector at a new random place in each picture.
Errors errors_at_random_places(int width_px, const TrackerSettings& settings, int n_pictures,
                               double speed_m_s = 0) {
  const Apparatus apparatus = default_apparatus(width_px);
  const SyntheticSettings scene;
  SyntheticCamera camera(apparatus, scene, 1);
  Tracker tracker(apparatus, settings);
  RandomStream random(2, "poses");
  Errors errors;
  for (int i = 0; i < n_pictures; ++i) {
    const Pose pose = random_held_pose(random);
    const double t_s = i / 30.0, angle = 2 * M_PI * random.uniform();
    const Eigen::Vector3d velocity =
        speed_m_s * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0);
    const auto path = [&](double at_s) -> std::optional<Pose> {
      return Pose{pose.position_m + (at_s - t_s) * velocity, pose.orientation};
    };
    const auto seen = tracker.track(camera.picture(path, t_s, static_cast<std::uint64_t>(i)), t_s);
    ++errors.n_pictures;
    if (!seen.camera_from_board) continue;
    const Pose& board = *seen.camera_from_board;
    errors.board_mm.push_back(1000 *
                              (board.position_m - scene.camera_from_board.position_m).norm());
    errors.board_deg.push_back(
        degrees * board.orientation.angularDistance(scene.camera_from_board.orientation));
    if (!seen.board_from_effector) continue;
    const Pose& effector = *seen.board_from_effector;
    errors.tip_mm.push_back(1000 * (effector * tip_m - pose * tip_m).norm());
    errors.effector_deg.push_back(degrees * effector.orientation.angularDistance(pose.orientation));
  }
  return errors;
}

TEST(Tracker, IsAsAccurateAsPromisedAt640) {
  const Errors errors = errors_at_random_places(640, {}, 120);
  EXPECT_EQ(errors.board_mm.size(), 120U);
  EXPECT_LT(Errors::p95(errors.board_mm), 0.06);
  EXPECT_LT(Errors::p95(errors.board_deg), 0.03);
  EXPECT_GT(errors.tip_mm.size(), 80U);  // the rest is under the fingers
  EXPECT_LT(Errors::p95(errors.tip_mm), 0.6);
  EXPECT_LT(Errors::p95(errors.effector_deg), 0.5);
  EXPECT_LT(*std::ranges::max_element(errors.effector_deg), 10) << "a flip";
}

TEST(Tracker, IsAsAccurateAsPromisedAt1280) {
  const Errors errors = errors_at_random_places(1280, {}, 40);
  EXPECT_LT(Errors::p95(errors.board_mm), 0.05);
  EXPECT_LT(Errors::p95(errors.tip_mm), 0.45);
  EXPECT_LT(Errors::p95(errors.effector_deg), 0.3);
}

TEST(Tracker, HoldsInMotion) {
  const Errors errors = errors_at_random_places(640, {}, 60, 0.5);
  EXPECT_GT(errors.tip_mm.size(), 35U);
  EXPECT_LT(Errors::p95(errors.tip_mm), 1.2);
}

TEST(Tracker, FindsMoreThanADecimatedSearch) {
  TrackerSettings coarse;
  coarse.decimate = 2;
  const auto found = [](const TrackerSettings& settings) {
    return errors_at_random_places(640, settings, 60).tip_mm.size();
  };
  EXPECT_GE(found({}), found(coarse) + 5);
}

TEST(Tracker, RemovingABiasThatIsNotThereDoesNoHarm) {
  TrackerSettings kept;
  kept.remove_bias = false;
  EXPECT_LE(Errors::p95(errors_at_random_places(640, {}, 120).tip_mm),
            1.06 * Errors::p95(errors_at_random_places(640, kept, 120).tip_mm));
}

TEST(Tracker, KnowsThatAnOverexposedPictureShowsLittle) {
  const Apparatus apparatus = default_apparatus(640);
  SyntheticSettings scene;
  scene.optics.exposure = 1.5;
  SyntheticCamera camera(apparatus, scene, 1);
  Tracker tracker(apparatus);
  const Pose pose = upright_pose({0, 0, 0.05}, 1.2);
  const auto seen = tracker.track(camera.picture([&](double) { return pose; }, 0, 0), 0);
  ASSERT_TRUE(seen.board_from_effector);
  EXPECT_LT(seen.quality, 0.5);
  EXPECT_LT((*seen.board_from_effector * tip_m - pose * tip_m).norm(), 0.004);
}

// The same grip, rolled: a pose's error is random, its quality is not.
TEST(Tracker, KnowsThatOneFaceShowsLessThanTwo) {
  const Apparatus apparatus = default_apparatus(640);
  SyntheticSettings scene;
  scene.hand = false;
  scene.optics.noise = 10;
  SyntheticCamera camera(apparatus, scene, 1);
  Tracker tracker(apparatus);
  const auto rolled = [&](double roll_rad) {
    tracker.reset();
    Pose pose = upright_pose({0, 0, 0.05}, M_PI / 2);
    pose.orientation = pose.orientation * Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitX());
    return tracker.track(camera.picture([&](double) { return pose; }, 0, 0), 0);
  };
  const TrackedPicture one = rolled(0), two = rolled(0.75);
  EXPECT_EQ(one.n_effector_faces, 1);
  EXPECT_EQ(two.n_effector_faces, 2);
  EXPECT_GT(two.quality, 0.7);
  EXPECT_LT(one.quality, two.quality - 0.05);
}

// Small tags, noise and motion blur: many poses are lost, and the others have small errors.
TEST(Tracker, WhatIsCentimetersOffIsNoPose) {
  Apparatus apparatus = default_apparatus(640);
  apparatus.effector = box_effector(0.025);
  SyntheticSettings scene;
  scene.optics.noise = 6;
  scene.optics.exposure_s = 0.008;
  SyntheticCamera camera(apparatus, scene, 1);
  Tracker tracker(apparatus);
  RandomStream random(4, "poses");
  int n_found = 0, n_lost = 0;
  for (int i = 0; i < 80; ++i) {
    const Pose pose = random_held_pose(random);
    const auto path = [&](double at_s) -> std::optional<Pose> {
      return Pose{pose.position_m + at_s * Eigen::Vector3d(0.3, 0.2, 0), pose.orientation};
    };
    tracker.reset();
    const auto seen = tracker.track(camera.picture(path, 0, static_cast<std::uint64_t>(i)), 0);
    EXPECT_EQ(seen.board_from_effector.has_value(), seen.quality >= least_pose_quality);
    ++(seen.board_from_effector ? n_found : n_lost);
    if (seen.board_from_effector)
      EXPECT_LT((*seen.board_from_effector * tip_m - pose * tip_m).norm(), 0.010) << i;
    else
      EXPECT_EQ(seen.quality, 0) << i;
  }
  EXPECT_GT(n_found, 15);
  EXPECT_GT(n_lost, 15);
}

// Poses with large errors, which the detector's corners cause more often, are discarded.
TEST(Tracker, IsSeveralTimesBetterThanTheDetectorsCorners) {
  TrackerSettings plain;
  plain.refine_edges = plain.remove_bias = plain.region_of_interest = false;
  const double plain_mm = Errors::p95(errors_at_random_places(640, plain, 50).tip_mm);
  EXPECT_GT(plain_mm, 6 * Errors::p95(errors_at_random_places(640, {}, 50).tip_mm));
}

TEST(Tracker, TakesTheBiasOfAnUnknownToneCurveFromTheBoard) {
  const Apparatus apparatus = default_apparatus(640);
  SyntheticSettings scene;
  scene.optics.gamma = 1;
  SyntheticCamera camera(apparatus, scene, 1);
  Tracker tracker(apparatus);
  const auto seen = tracker.track(
      camera.picture([](double) -> std::optional<Pose> { return std::nullopt; }, 0, 0), 0);
  ASSERT_TRUE(seen.camera_from_board);
  EXPECT_LT(std::abs(seen.edge_bias_px), 0.02);  // of about .3 that a linear curve makes
  EXPECT_LT((seen.camera_from_board->position_m - scene.camera_from_board.position_m).norm(),
            0.0002);
  EXPECT_EQ(seen.n_board_tags, 24);
}

class TrackerOverTime : public testing::Test {
 protected:
  TrackedPicture see(const std::optional<Pose>& effector, double t_s) {
    const auto path = [&](double) { return effector; };
    return tracker.track(camera.picture(path, t_s, number++), t_s);
  }

  static Pose held_at(double x_m, double y_m) { return upright_pose({x_m, y_m, 0.05}, 1.2); }

  Apparatus apparatus = default_apparatus(640);
  SyntheticCamera camera{apparatus, {}, 1};
  Tracker tracker{apparatus};
  std::uint64_t number = 0;
};

TEST_F(TrackerOverTime, MotionIsNoJump) {
  EXPECT_TRUE(see(held_at(0, 0), 0).jump);  // there is nothing that it could continue
  for (int i = 1; i < 6; ++i) {
    const auto seen = see(held_at(0.017 * i, 0), i / 30.0);
    ASSERT_TRUE(seen.board_from_effector) << i;
    EXPECT_FALSE(seen.jump) << i;
  }
}

// The effector is found by its edges at the predicted place: when it moves steadily, nothing is
// searched.
TEST_F(TrackerOverTime, WhatMovesAsBeforeIsNotSearchedFor) {
  for (int i = 0; i < 8; ++i) {
    const Pose truth = held_at(0.013 * i, 0.01);
    const auto seen = see(truth, i / 30.0);
    ASSERT_TRUE(seen.board_from_effector) << i;
    EXPECT_LT((*seen.board_from_effector * tip_m - truth * tip_m).norm(), 0.0005) << i;
    if (i >= 3) {
      EXPECT_EQ(seen.times.detect_s, 0) << i;
    }
  }
}

// ... and it is detected if it is not there.
TEST_F(TrackerOverTime, WhatStopsAtOnceIsFoundAllTheSame) {
  for (int i = 0; i < 4; ++i) see(held_at(0.017 * i, 0), i / 30.0);
  const auto seen = see(held_at(0.017 * 3, 0), 4 / 30.0);
  ASSERT_TRUE(seen.board_from_effector);
  EXPECT_GT(seen.times.detect_s, 0);
  EXPECT_LT((*seen.board_from_effector * tip_m - held_at(0.017 * 3, 0) * tip_m).norm(), 0.0005);
}

// Edges alone would accept any square as its tag.
TEST_F(TrackerOverTime, AnotherThingInItsPlaceIsNotTakenForIt) {
  Apparatus other = apparatus;
  for (Tag& tag : other.effector.tags) tag.id += 100;
  SyntheticCamera others_camera(other, {}, 1);
  const Pose pose = held_at(0, 0);
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(see(pose, i / 30.0).board_from_effector);
  const auto seen = tracker.track(others_camera.picture([&](double) { return pose; }, 0.1, 9), 0.1);
  EXPECT_TRUE(seen.camera_from_board);
  EXPECT_FALSE(seen.board_from_effector);
}

TEST_F(TrackerOverTime, AnEffectorThatIsSomewhereElseJumped) {
  see(held_at(-0.1, 0), 0);
  const auto seen = see(held_at(0.1, 0.03), 1 / 30.0);
  ASSERT_TRUE(seen.board_from_effector);
  EXPECT_TRUE(seen.jump);
  EXPECT_LT((seen.board_from_effector->position_m - held_at(0.1, 0.03).position_m).norm(), 0.002);
}

TEST_F(TrackerOverTime, OutOfViewIsNoPoseAndComingBackALongTimeLaterIsAJump) {
  see(held_at(0, 0), 0);
  const auto gone = see(std::nullopt, 1 / 30.0);
  EXPECT_TRUE(gone.camera_from_board);
  EXPECT_FALSE(gone.board_from_effector);
  EXPECT_EQ(gone.n_effector_tags, 0);
  EXPECT_FALSE(see(held_at(0.005, 0), 2 / 30.0).jump);
  see(std::nullopt, 3 / 30.0);
  EXPECT_TRUE(see(held_at(0.005, 0), 1).jump);
}

TEST_F(TrackerOverTime, OutOfViewForLongItIsFoundWithinTwoPictures) {
  int picture = 0;
  for (const double x_m : {-0.1, 0.0, 0.1}) {
    for (int i = 0; i < 5; ++i, ++picture)
      EXPECT_FALSE(see(std::nullopt, picture / 30.0).board_from_effector);
    const bool at_once = see(held_at(x_m, 0), picture++ / 30.0).board_from_effector.has_value();
    const auto next = see(held_at(x_m, 0), picture++ / 30.0);
    EXPECT_TRUE(next.board_from_effector) << x_m;
    EXPECT_EQ(next.jump, !at_once) << x_m;
  }
}

TEST_F(TrackerOverTime, ResetForgets) {
  see(held_at(0, 0), 0);
  tracker.reset();
  EXPECT_TRUE(see(held_at(0, 0), 1 / 30.0).jump);
}

TEST_F(TrackerOverTime, LostInTheDarkAndFoundAgain) {
  see(held_at(0, 0), 0);
  Image dark(640, 480, 3);
  const auto lost = tracker.track(dark, 1 / 30.0);
  EXPECT_FALSE(lost.camera_from_board);
  EXPECT_FALSE(lost.board_from_effector);
  EXPECT_TRUE(see(held_at(0, 0), 2 / 30.0).board_from_effector);
}

TEST_F(TrackerOverTime, RefusesAPictureOfAnotherSize) {
  try {
    tracker.track(Image(320, 240, 1), 0);
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("320 x 240"));
    EXPECT_THAT(error.what(), HasSubstr("640 x 480"));
  }
}

TEST(TrackerApparatus, EveryFamilyCanBeABoard) {
  for (const char* family : {"tag36h11", "tag25h9", "tag16h5", "tagStandard41h12"}) {
    Apparatus apparatus{default_camera(640, 480), grid_board(3, 2, 0.060, 0.090), {}};
    apparatus.board.family = family;
    if (std::string(family) == "tagStandard41h12")  // its data ring lies outside of the corners
      apparatus.board = grid_board(3, 2, 0.040, 0.090), apparatus.board.family = family;
    const SyntheticSettings scene;
    SyntheticCamera camera(apparatus, scene, 1);
    Tracker tracker(apparatus);
    const auto seen = tracker.track(
        camera.picture([](double) -> std::optional<Pose> { return std::nullopt; }, 0, 0), 0);
    ASSERT_TRUE(seen.camera_from_board) << family;
    EXPECT_EQ(seen.n_board_tags, 6) << family;
    EXPECT_LT((seen.camera_from_board->position_m - scene.camera_from_board.position_m).norm(),
              0.0003)
        << family;
    EXPECT_GT(seen.quality, 0.9) << family;
  }
}

TEST(TrackerApparatus, ASingleTagIsEnough) {
  const Apparatus apparatus{default_camera(640, 480), grid_board(1, 1, 0.080, 0.090), {}};
  const SyntheticSettings scene;
  SyntheticCamera camera(apparatus, scene, 1);
  Tracker tracker(apparatus);
  for (int i = 0; i < 3; ++i) {
    const auto seen = tracker.track(
        camera.picture([](double) -> std::optional<Pose> { return std::nullopt; }, 0, 0), i / 30.0);
    ASSERT_TRUE(seen.camera_from_board);
    EXPECT_LT((seen.camera_from_board->position_m - scene.camera_from_board.position_m).norm(),
              0.001);
  }
}

// The board is found again by its edges at its last place, in any light in which it was detected
// first.
TEST(TrackerApparatus, NoiseAndDimLightTakeNoSearchAPicture) {
  Apparatus apparatus = default_apparatus(640);
  apparatus.effector = {};
  for (const auto& [light, noise] : {std::pair{1.0, 20.0}, {0.1, 6.0}, {0.2, 12.0}}) {
    SyntheticSettings scene;
    scene.optics.exposure = light;
    scene.optics.noise = noise;
    SyntheticCamera camera(apparatus, scene, 1);
    Tracker tracker(apparatus);
    for (int i = 0; i < 5; ++i) {
      const auto nothing = [](double) -> std::optional<Pose> { return std::nullopt; };
      const auto seen = tracker.track(camera.picture(nothing, 0, static_cast<std::uint64_t>(i)), i);
      ASSERT_TRUE(seen.camera_from_board) << light << ' ' << noise;
      EXPECT_EQ(seen.times.detect_s > 0, i == 0) << light << ' ' << noise << " picture " << i;
    }
  }
}

TEST(TrackerApparatus, SharedTagsUnknownFamiliesAndEmptyBoardsAreRefused) {
  Apparatus shared = default_apparatus(640);
  shared.effector.tags[0].id = 7;
  EXPECT_THROW(Tracker{shared}, Error);
  Apparatus unknown = default_apparatus(640);
  unknown.board.family = "tag99h1";
  EXPECT_THROW(Tracker{unknown}, Error);
  Apparatus beyond = default_apparatus(640);
  beyond.board.tags[0].id = 587;
  EXPECT_THROW(Tracker{beyond}, Error);
  Apparatus empty = default_apparatus(640);
  empty.board.tags.clear();
  EXPECT_THROW(Tracker{empty}, Error);
}

TEST(TrackerApparatus, NoiseAndTinyPicturesHoldNothing) {
  RandomStream random(3, "pixels");
  for (const auto& [width, height] : {std::pair{640, 480}, {1, 1}, {3, 200}, {40, 40}, {17, 9}}) {
    Apparatus apparatus = default_apparatus(640);
    apparatus.camera = default_camera(width, height);
    Tracker tracker(apparatus);
    for (const int channels : {1, 3})
      for (int i = 0; i < 3; ++i) {
        Image image(width, height, channels);
        for (auto& pixel : image.pixels) pixel = static_cast<std::uint8_t>(random.below(256));
        const auto seen = tracker.track(image, i / 30.0);
        EXPECT_FALSE(seen.board_from_effector);
        EXPECT_EQ(seen.camera_from_board.has_value(), seen.n_board_tags > 0);
      }
  }
}

// AprilTag alone reads two thirds of these tags.
TEST(Tracker, ReadsTagsThatAreOutOfFocus) {
  const Apparatus apparatus = default_apparatus(640);
  SyntheticSettings usual, defocused;
  defocused.optics.blur_px = 1.5;
  RandomStream grips(21, "grips");
  int n_usual = 0, n_defocused = 0;
  for (std::uint64_t i = 0; i < 30; ++i) {
    const Pose pose = random_held_pose(grips);
    const auto held = [&](double) { return std::optional(pose); };
    const auto is_found = [&](const SyntheticSettings& settings) {
      const Image picture = SyntheticCamera(apparatus, settings, 1).picture(held, 0, i);
      return Tracker(apparatus).track(picture, 0).board_from_effector.has_value();
    };
    n_usual += is_found(usual);
    n_defocused += is_found(defocused);
  }
  EXPECT_GE(n_defocused, 0.85 * n_usual);
}

}  // namespace
}  // namespace heft
