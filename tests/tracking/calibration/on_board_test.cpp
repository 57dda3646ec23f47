// The ratio of two prints, from pictures of the effector standing on the board.
#include <gtest/gtest.h>

#include "base/Error.h"
#include "tracking/calibration/CalibrationViews.h"
#include "tracking/calibration/OnBoardCalibration.h"

namespace heft {
namespace {

constexpr std::uint64_t seed = 20261127;

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  return text;
}

enum class Down { bottom, back, left };

// The effector at a random place on the board, on one of its faces.
Pose put_down(RandomStream& random, const MarkerBody& effector, Down face) {
  const auto within = [&](double half) { return half * (2 * random.uniform() - 1); };
  const Eigen::AngleAxisd yaw(within(M_PI), Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d half_m = effector.size_m / 2;
  const auto at = [&](double height_m, const Eigen::Quaterniond& turn) {
    return Pose{{within(0.10), within(0.07), height_m}, yaw * turn};
  };
  if (face == Down::back)
    return at(half_m.x(),
              Eigen::Quaterniond(Eigen::AngleAxisd(-M_PI / 2, Eigen::Vector3d::UnitY())));
  if (face == Down::left)
    return at(half_m.y(),
              Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitX())));
  return at(half_m.z(), Eigen::Quaterniond::Identity());
}

// A print that is larger as a whole, as some printers produce.
Apparatus larger(Apparatus apparatus, double scale) {
  apparatus.effector.size_m *= scale;
  for (Tag& tag : apparatus.effector.tags)
    for (Eigen::Vector3d& corner_m : tag.corners_m) corner_m *= scale;
  return apparatus;
}

class Table {
 public:
  Table(const Apparatus& made, const MarkerBody& board, const MarkerBody& effector,
        double tag_scale = 1)
      : camera_(made, settings(tag_scale), seed), views(board, effector, made.camera, false) {}

  bool film(const Pose& pose) {
    const auto number = static_cast<std::uint64_t>(n_++);
    return views.offer(camera_.picture([&](double) { return std::optional(pose); }, 0, number),
                       "picture " + std::to_string(number));
  }

 private:
  static SyntheticSettings settings(double tag_scale) {
    SyntheticSettings settings;
    settings.hand = false;
    settings.files.effector_tag_scale = tag_scale;
    return settings;
  }
  SyntheticCamera camera_;
  int n_ = 0;

 public:
  StandingViews views;
};

OnBoardCalibration found(const Apparatus& made, MarkerBody board, MarkerBody effector, int n,
                         double tag_scale = 1) {
  Table table(made, board, effector, tag_scale);
  RandomStream random(seed, "on the board");
  for (int i = 0; i < n; ++i) table.film(put_down(random, made.effector, Down(i % 3)));
  return calibrate_on_board(board, effector, made.camera, table.views.views());
}

// In each repetition it stands at one unknown place.
TEST(OnBoardCalibration, FindsAPrintThatIsTooLarge) {
  const Apparatus file = default_apparatus(640);
  const Apparatus made = larger(file, 1.01);
  int n_within = 0, n = 0;
  RandomStream random(seed, "once");
  for (int i = 0; i < 24; ++i) {
    Table table(made, file.board, file.effector);
    if (!table.film(put_down(random, made.effector, Down(i % 3)))) continue;
    const auto once =
        calibrate_on_board(file.board, file.effector, made.camera, table.views.views());
    EXPECT_NEAR(once.tag_scale, 1.01, 0.003) << "picture " << i << ", seed " << seed;
    ++n;
    n_within += std::abs(once.tag_scale - 1.01) < std::min(0.002, 2 * once.tag_scale_sd);
  }
  EXPECT_GE(n, 22) << "seed " << seed;
  EXPECT_GE(n_within, 0.95 * n) << "seed " << seed;
}

TEST(OnBoardCalibration, WritesAnEffectorThatFitsTheBoard) {
  const Apparatus file = default_apparatus(640);
  const Apparatus made = larger(file, 1.01);
  const auto several = found(made, file.board, file.effector, 6);
  EXPECT_NEAR(several.tag_scale, 1.01, 0.001);
  EXPECT_LT(several.tag_scale_sd, 0.001);
  EXPECT_TRUE(several.is_uniform());
  EXPECT_LT(placement_error_m(several.effector.tags, made.effector.tags), 0.00005);
  EXPECT_NEAR(*several.effector.measured_ruler_m, 0.1515, 0.0002);
  EXPECT_NE(summary(several).find("larger than in its file"), std::string::npos);
}

// Tags that were printed separately are at the file's places.
TEST(OnBoardCalibration, NamesTagsThatDoNotFitTheirPlaces) {
  const Apparatus file = default_apparatus(640);
  const auto several = found(file, file.board, file.effector, 6, 1.01);
  EXPECT_NEAR(several.tag_scale, 1.01, 0.001);
  EXPECT_NEAR(several.place_scale, 1, 0.001);
  EXPECT_NE(joined(doubts(several)).find("larger than the distances between them"),
            std::string::npos);
}

TEST(OnBoardCalibration, NamesARulerThatWasMeasuredWrongly) {
  const Apparatus file = default_apparatus(640);
  Apparatus measured = file;
  measured.board.measured_ruler_m = measured.effector.measured_ruler_m = ruler_m;
  EXPECT_EQ(joined(doubts(found(file, measured.board, measured.effector, 6))), "");
  const std::string why =
      joined(doubts(found(larger(file, 1.01), measured.board, measured.effector, 6)));
  EXPECT_NE(why.find("the rulers of both sheets disagree by"), std::string::npos) << why;
  const std::string none = joined(doubts(found(file, file.board, measured.effector, 6)));
  EXPECT_NE(none.find("the board's ruler was not measured"), std::string::npos) << none;
}

TEST(OnBoardCalibration, LeavesOutALiftedEffector) {
  const Apparatus file = default_apparatus(640);
  Table table(file, file.board, file.effector);
  RandomStream random(seed, "lifted");
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(table.film(put_down(random, file.effector, Down::back)));
  Pose lifted = put_down(random, file.effector, Down::back);
  lifted.position_m.z() += 0.006;
  lifted.orientation = Eigen::AngleAxisd(0.06, Eigen::Vector3d::UnitX()) * lifted.orientation;
  ASSERT_TRUE(table.film(lifted));
  const auto result =
      calibrate_on_board(file.board, file.effector, file.camera, table.views.views());
  EXPECT_EQ(result.n_left_out, 1);
  EXPECT_NEAR(result.tag_scale, 1, 0.001);
}

TEST(StandingViews, SayWhatTheyDoNotShow) {
  const Apparatus file = default_apparatus(640);
  Table table(file, file.board, file.effector);
  EXPECT_FALSE(table.views.offer(Image(640, 480, 1), "gray"));
  EXPECT_FALSE(table.film({{0, -0.02, 0.09}, Eigen::Quaterniond::Identity()}));
  EXPECT_FALSE(table.film({{9, 0, 0.02}, Eigen::Quaterniond::Identity()}));
  EXPECT_TRUE(table.film({{0, -0.02, 0.02}, Eigen::Quaterniond::Identity()}));
  EXPECT_FALSE(table.film({{0, -0.02, 0.02}, Eigen::Quaterniond::Identity()}));
  EXPECT_EQ(table.views.tally(),
            "of 5 pictures 1 were kept; 1 do not show the board clearly (4 tags or more); 1 do "
            "not show a tag of the effector clearly; 1 show it above the board or tilted; 1 show "
            "it where another one does");
  EXPECT_THROW(table.views.offer(Image(320, 240, 1), "small"), Error);
  EXPECT_THROW(calibrate_on_board(file.board, file.effector, file.camera, {}), Error);
}

// A hand puts it down and takes it away.
TEST(StandingViews, TakeAStillOneOfALiveCamera) {
  const Apparatus file = default_apparatus(640);
  SyntheticSettings settings;
  SyntheticCamera camera(file, settings, seed);
  StandingViews views(file.board, file.effector, file.camera, true);
  const auto film = [&](double x_m, std::uint64_t number) {
    const Pose pose{{x_m, -0.02, 0.02}, Eigen::Quaterniond::Identity()};
    return views.offer(camera.picture([&](double) { return std::optional(pose); }, 0, number), "");
  };
  EXPECT_FALSE(film(0.01, 0));
  EXPECT_FALSE(film(0.02, 1));
  EXPECT_TRUE(film(0.02, 2));
}

}  // namespace
}  // namespace heft
