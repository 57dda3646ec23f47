// The camera's tone curve: learned from the board, stored in its file, used by the tracker.
#include "tracking/calibration/Response.h"

#include <gtest/gtest.h>

#include "base/Error.h"
#include "tracking/Tracker.h"
#include "tracking/calibration/CalibrationViews.h"

namespace heft {
namespace {

std::vector<Image> views_by(const std::optional<double>& gamma, int n) {
  const Apparatus apparatus = default_apparatus(640);
  RandomStream random(3, "views");
  std::vector<Image> pictures;
  for (int i = 0; i < n; ++i) {
    SyntheticSettings settings;
    settings.camera_from_board = view_of_board(random, 1);
    settings.hand = false;
    settings.optics.gamma = gamma;
    SyntheticCamera camera({apparatus.camera, apparatus.board, {}}, settings, 1);
    pictures.push_back(
        camera.picture([](double) { return std::nullopt; }, 0, static_cast<std::uint64_t>(i)));
  }
  return pictures;
}

TEST(Response, IsLearnedFromViewsOfTheBoard) {
  const Apparatus apparatus = default_apparatus(640);
  const auto learned = [&](const std::optional<double>& gamma) {
    return learned_response(apparatus.camera, apparatus.board, views_by(gamma, 5));
  };
  const auto levels = [](const std::optional<std::array<double, 3>>& response) {
    Intrinsics camera;
    camera.response = response;
    return brighter_levels(response_of(camera), ToneCurve());
  };
  const auto srgb = learned(std::nullopt), linear = learned(1.0);
  ASSERT_TRUE(srgb && linear);
  EXPECT_LT(std::abs(levels(srgb)), bending_levels / 2);
  EXPECT_LT(levels(linear), -2 * bending_levels);

  // A tracker that knows it begins with it.
  Apparatus known = apparatus;
  known.camera.response = linear;
  const Tracker tracker(known);
  EXPECT_EQ(tracker.tone().bend(), ToneBend(linear->data()));
}

TEST(Response, OfBlackPicturesIsNone) {
  const Apparatus apparatus = default_apparatus(640);
  EXPECT_FALSE(learned_response(apparatus.camera, apparatus.board, {Image(640, 480, 1)}));
}

TEST(Response, LevelsCompareBetweenBlackAndWhite) {
  EXPECT_NEAR(brighter_levels(ToneCurve(), ToneCurve()), 0, 0.01);
  const ToneCurve bent(ToneBend(0.5, 0.1, 0.2));
  EXPECT_NEAR(brighter_levels(bent, bent), 0, 0.1);
  EXPECT_LT(brighter_levels(bent, ToneCurve()) * brighter_levels(ToneCurve(), bent), 0);
}

TEST(Response, IsKeptInTheCamerasFile) {
  Intrinsics camera;
  EXPECT_EQ(parse_intrinsics(to_yaml(camera, ""), "c.yaml").response, std::nullopt);
  camera.response = std::array{-0.4, 0.125, 0.01};
  EXPECT_EQ(parse_intrinsics(to_yaml(camera, ""), "c.yaml").response, camera.response);
  for (const char* wrong :
       {"response: [ 0.1, 0.2 ]\n", "response: [ 0, 0, 3 ]\n", "response: [ 0, x, 0 ]\n"}) {
    camera.response.reset();
    try {
      parse_intrinsics(to_yaml(camera, "") + wrong, "c.yaml");
      ADD_FAILURE() << wrong;
    } catch (const InvalidFile& error) {
      EXPECT_NE(std::string(error.what()).find("response"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace heft
