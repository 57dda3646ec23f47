// Both calibrations against the synthetic camera's true values.
#include <gtest/gtest.h>

#include "base/Error.h"
#include "tracking/calibration/CalibrationViews.h"
#include "tracking/calibration/EffectorCalibration.h"
#include "tracking/calibration/ViewCollector.h"

namespace heft {
namespace {

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  return text;
}

// Twenty good views, and one of a print with another ratio of length to width, which neither pose
// nor edge bias explains: it must not affect the result.
TEST(CameraCalibration, FindsTheCameraAndLeavesOutWhatDoesNotFit) {
  const Apparatus apparatus = default_apparatus(640);
  BoardViews pictures = board_views(apparatus, 20, 1, 2);
  Apparatus stretched = apparatus;
  for (Tag& tag : stretched.board.tags)
    for (Eigen::Vector3d& corner_m : tag.corners_m) corner_m.y() *= 0.96;
  pictures.images.push_back(board_views(stretched, 1, 1, 9).images[0]);
  pictures.names.push_back("the odd one");
  const auto found = calibrate_camera(apparatus.board, pictures.images, pictures.names);
  const auto [p95_px, median_px] = ray_errors(found.camera, apparatus.camera);
  EXPECT_LT(p95_px, 0.2);
  EXPECT_LT(median_px, 0.1);
  EXPECT_LT(found.rms_px, 0.06);
  EXPECT_EQ(joined(doubts(found)), "");
  EXPECT_LT(std::abs(found.print.stretch), 0.0004);
  EXPECT_LT(std::abs(found.print.shear_rad), 0.0004);
  ASSERT_EQ(found.views.size(), 21u);
  EXPECT_EQ(found.n_used(), 20u);
  EXPECT_EQ(found.views.back().name, "the odd one");
  EXPECT_FALSE(found.views.back().used);
  EXPECT_NE(summary(found).find("20 views used of 21"), std::string::npos);
  // The overall size follows from rulers, not from pictures.
  EXPECT_NE(summary(found).find("ruler_measured_m"), std::string::npos);
}

// Stretched by 0.2 % and sheared by 0.15 degrees, as by printers that feed paper unevenly.
TEST(CameraCalibration, NamesAPrintThatIsNotTrueToShape) {
  const Apparatus apparatus = default_apparatus(640);
  Apparatus printed = apparatus;
  constexpr double stretch = 0.002, shear_rad = 0.0026;
  for (Tag& tag : printed.board.tags)
    for (Eigen::Vector3d& c : tag.corners_m)
      c = {c.x() * (1 + stretch / 2) + c.y() * shear_rad / 2,
           c.y() * (1 - stretch / 2) + c.x() * shear_rad / 2, 0};
  const BoardViews pictures = board_views(printed, 16, 1, 2);
  const auto found = calibrate_camera(apparatus.board, pictures.images, pictures.names);
  EXPECT_NEAR(found.print.stretch, stretch, 0.0004);
  EXPECT_NEAR(found.print.shear_rad, shear_rad, 0.0004);
  const std::string why = joined(doubts(found));
  EXPECT_NE(why.find("% (0.0"), std::string::npos) << why;
  EXPECT_NE(why.find("longer across than down"), std::string::npos) << why;
  EXPECT_NE(why.find("ruler_measured_m = [across, down]"), std::string::npos) << why;
  EXPECT_NE(why.find("the board's print is sheared"), std::string::npos) << why;
}

TEST(CameraCalibration, DoubtsViewsFromOneSide) {
  const Apparatus apparatus = default_apparatus(640);
  const BoardViews pictures = board_views(apparatus, 6, 0, 3);
  const auto found = calibrate_camera(apparatus.board, pictures.images, pictures.names);
  const std::string why = joined(doubts(found));
  EXPECT_NE(why.find("6 views are few"), std::string::npos) << why;
  EXPECT_NE(why.find("tilt the board"), std::string::npos) << why;
}

TEST(CameraCalibration, RefusesPicturesWithoutTheBoard) {
  const MarkerBody board = default_apparatus(640).board;
  const std::vector<Image> gray(6, Image(640, 480, 1));
  try {
    calibrate_camera(board, gray, std::vector<std::string>(6, "gray"));
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("0 of 6 pictures"), std::string::npos);
  }
  EXPECT_THROW(calibrate_camera(board, {}, {}), Error);
}

TEST(Coverage, NamesTheEmptiestPart) {
  Coverage coverage;
  EXPECT_EQ(coverage.fraction(), 0);
  for (auto& row : coverage.corners) row.fill(20);
  EXPECT_EQ(coverage.emptiest(), "");
  coverage.corners[5][7] = 0;
  EXPECT_EQ(coverage.emptiest(), "the lower right");
  coverage.corners[0][0] = coverage.corners[0][1] = 0;
  EXPECT_EQ(coverage.emptiest(), "the upper left");
  EXPECT_NEAR(coverage.fraction(), 45.0 / 48, 1e-12);
  EXPECT_EQ(coverage.drawing().substr(0, 17), " . . # # # # # #\n");
}

// Each view is kept once, only if still, and the instruction names the missing side.
TEST(ViewCollector, KeepsWhatIsNewAndStill) {
  const Apparatus apparatus = default_apparatus(640);
  const BoardViews pictures = board_views(apparatus, 3, 1, 4);
  ViewCollector live(apparatus.board, 640, 480, true);
  EXPECT_FALSE(live.offer(pictures.images[0], "moving in"));
  EXPECT_TRUE(live.offer(pictures.images[0], "still"));
  EXPECT_FALSE(live.offer(pictures.images[0], "still there"));
  EXPECT_FALSE(live.offer(pictures.images[1], "moving on"));
  EXPECT_TRUE(live.offer(pictures.images[1], "still"));
  EXPECT_EQ(live.size(), 2u);
  EXPECT_FALSE(live.complete());
  EXPECT_NE(live.wanted(), "");
  EXPECT_THROW(live.offer(Image(320, 240, 1), "a small one"), Error);

  ViewCollector file(apparatus.board, 640, 480, false);
  for (const Image& image : pictures.images) EXPECT_TRUE(file.offer(image, "a file"));
  EXPECT_FALSE(file.offer(pictures.images[0], "the same again"));
}

// Similar pictures do not mean a wrong board file: the message has their number and the missing
// views.
TEST(ViewCollector, SaysWhatIsMissing) {
  const Apparatus apparatus = default_apparatus(640);
  const BoardViews pictures = board_views(apparatus, 2, 0, 4);
  ViewCollector views(apparatus.board, 640, 480, false);
  for (int i = 0; i < 3; ++i) views.offer(pictures.images[0], "again");
  views.offer(pictures.images[1], "another");
  views.offer(Image(640, 480, 1), "gray");
  EXPECT_EQ(views.tally(),
            "of 5 pictures 2 were kept; 1 don't show the board clearly (4 tags or more); 2 are "
            "too similar to one that was kept");
  const std::string missing = joined(views.missing());
  for (const char* what : {"tilt the board", "of the picture", "18 more views"})
    EXPECT_NE(missing.find(what), std::string::npos) << missing;

  ViewCollector near_and_far(apparatus.board, 640, 480, false);
  const BoardViews many = board_views(apparatus, 24, 1, 2);
  for (std::size_t i = 0; i < many.images.size(); ++i)
    near_and_far.offer(many.images[i], many.names[i]);
  EXPECT_EQ(joined(near_and_far.missing()), "");
  EXPECT_TRUE(near_and_far.complete());
}

TEST(CameraCalibration, DoubtsViewsFromOneDistance) {
  CameraCalibration calibration;
  calibration.views.resize(20);
  for (CalibratedView& view : calibration.views) view.distance_m = 0.4;
  EXPECT_NE(joined(doubts(calibration)).find("one distance"), std::string::npos);
  calibration.views[7].distance_m = 0.5;
  EXPECT_EQ(joined(doubts(calibration)).find("one distance"), std::string::npos);
}

TEST(TagViews, OutwardMovesGrowASquareByAPixel) {
  const std::array<Eigen::Vector2d, 4> square{{{10, 10}, {30, 10}, {30, 30}, {10, 30}}};
  const auto moves = outward_moves(square);
  EXPECT_LT((moves[0] - Eigen::Vector2d(-1, -1)).norm(), 1e-12);
  EXPECT_LT((moves[2] - Eigen::Vector2d(1, 1)).norm(), 1e-12);
}

std::vector<TagView> views_of(const Apparatus& made, const MarkerBody& nominal, int n,
                              std::uint64_t seed) {
  TagViewer viewer(nominal);
  std::vector<TagView> views;
  for (const Image& picture : effector_pictures(made, n, seed))
    views.push_back(viewer.view(picture, made.camera));
  return views;
}

TEST(EffectorCalibration, FindsWhereTagsReallyAre) {
  Apparatus made = default_apparatus(640);
  const MarkerBody nominal = made.effector;
  made.effector = handmade(nominal, 1);
  const auto found = calibrate_effector(nominal, made.camera, views_of(made, nominal, 70, 1));
  EXPECT_GT(placement_error_m(nominal.tags, made.effector.tags), 0.0010);
  EXPECT_LT(placement_error_m(found.effector.tags, made.effector.tags), 0.0001);
  EXPECT_LT(found.rms_px, 0.2);
  EXPECT_EQ(joined(doubts(found)), "");
  EXPECT_EQ(found.effector.size_m, nominal.size_m);
  // Tags keep their printed size; origin and axes remain the file's as far as possible.
  Eigen::Vector3d shift(0, 0, 0);
  for (std::size_t i = 0; i < nominal.tags.size(); ++i) {
    const auto& c = found.effector.tags[i].corners_m;
    EXPECT_NEAR((c[1] - c[0]).norm(), 0.032, 1e-9);
    shift += tag_center_m(found.effector.tags[i]) - tag_center_m(nominal.tags[i]);
  }
  EXPECT_LT(shift.norm(), 1e-9);
}

std::string refusal(const Apparatus& made, const std::vector<TagView>& views) {
  try {
    calibrate_effector(made.effector, made.camera, views);
  } catch (const Error& error) {
    return error.what();
  }
  return "calibrated";
}

// A tag at a wrong place in the file would cause errors in every picture that shows it.
TEST(EffectorCalibration, RefusesATagThatItSawTooLittle) {
  const Apparatus made = default_apparatus(640);
  std::vector<TagView> views = views_of(made, made.effector, 70, 1);
  ASSERT_EQ(refusal(made, views), "calibrated");
  for (TagView& view : views)
    std::erase_if(view.tags, [](const auto& seen) { return seen.tag == 3; });
  EXPECT_NE(refusal(made, views).find("tag 33 (pictures: 0)"), std::string::npos)
      << refusal(made, views);
  views.resize(3);
  EXPECT_NE(refusal(made, views).find("too rarely beside another tag: 30, 31, 32, 33, 34"),
            std::string::npos)
      << refusal(made, views);
}

TEST(EffectorCalibration, RefusesTooFewViews) {
  const Apparatus made = default_apparatus(640);
  EXPECT_THROW(calibrate_effector(made.effector, made.camera, {}), Error);
  EXPECT_THROW(calibrate_effector(made.effector, made.camera, std::vector<TagView>(20)), Error);
}

}  // namespace
}  // namespace heft
