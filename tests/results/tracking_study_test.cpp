// The quick study of tracking writes its files with their columns; compared trackers, motions and
// filters are as they are described.
#include <gtest/gtest.h>

#include <cmath>

#include "SourceFolder.h"
#include "StudyFolder.h"
#include "base/Random.h"
#include "protocol/readers/Files.h"
#include "results/tracking/TrackingStudy.h"
#include "results/tracking/comparison/ComparisonTracker.h"

namespace heft {
namespace {

TEST(TrackingStudy, QuickRunMakesEveryFile) {
  const StudyFolder study("tracking");
  testing::internal::CaptureStdout();
  run_tracking_study(study.options());
  EXPECT_NE(testing::internal::GetCapturedStdout().find("board in camera, p95"), std::string::npos);

  const auto accuracy = study.csv("accuracy.csv");
  EXPECT_EQ(accuracy.rows.size(), 4U);  // ours and the plain chain at two sizes
  for (const char* column : {"tip_p95_mm", "board_p95_mm", "effector_p95_deg", "time_median_ms"})
    for (const double value : accuracy.numbers(column)) EXPECT_GT(value, 0) << column;
  const auto limits = study.csv("limits.csv");
  EXPECT_EQ(limits.rows.size(), 3 * 2 * static_cast<std::size_t>(limit_parts));
  for (const double share : limits.numbers("effector_found")) EXPECT_LE(share, 1);
  const auto filters = study.csv("filters.csv");
  EXPECT_EQ(filters.rows.size(), smoothers().size());
  for (const double jitter : filters.numbers("jitter_mm")) EXPECT_GT(jitter, 0);
  EXPECT_EQ(study.csv("goals.csv").rows.size(), 33U);
  const auto faults = study.csv("faults.csv");
  EXPECT_EQ(faults.rows.size() % 4, 0U);  // ours and the plain chain at two sizes
  EXPECT_GT(faults.rows.size(), 4 * 12U);
  for (const double share : faults.numbers("effector_found")) EXPECT_LE(share, 1);
  EXPECT_NE(study.text("goals.csv").find("false poses"), std::string::npos);
  EXPECT_NE(study.text("goals.csv").find("camera calibration from 6 views"), std::string::npos);
  for (const double bound : study.csv("bound.csv").numbers("bound_mm")) EXPECT_GT(bound, 0);
  for (const char* chart : {"accuracy.svg", "limits.svg", "faults.svg", "filters.svg"})
    EXPECT_TRUE(study.has_chart(chart)) << chart;
  const std::string readme = study.text("README.md");
  EXPECT_NE(readme.find("quick run"), std::string::npos);
  EXPECT_NE(readme.find("| gamma 2.2 | "), std::string::npos);
  EXPECT_EQ(readme.find("nan"), std::string::npos);
}

TEST(EffectorStudy, QuickRunMakesEveryFile) {
  const StudyFolder study("effectors");
  testing::internal::CaptureStdout();
  run_effector_study(study.options());
  EXPECT_NE(testing::internal::GetCapturedStdout().find("effector_two_faces.toml"),
            std::string::npos);
  EXPECT_EQ(study.csv("effectors.csv").rows.size(), 4U);
  EXPECT_NE(study.text("README.md").find("quick run"), std::string::npos);
}

// By geometry alone, over the grips and camera positions of studies.
double share_with_two_tags(EffectorBody body) {
  EffectorPrint print;
  print.body = body;
  const Apparatus apparatus = bench_apparatus(640, print);
  constexpr int n_grips = 500;
  int n = 0, n_two = 0;
  for (const auto& [distance_m, pitch_deg] :
       {std::pair(0.42, 46.0), {0.45, 52.0}, {0.48, 58.0}, {0.44, 60.0}})
    for (std::uint64_t i = 0; i < n_grips; ++i, ++n)
      if (tags_in_view(apparatus, camera_above_board(distance_m, pitch_deg * M_PI / 180),
                       random_grip(7, i)) >= 2)
        ++n_two;
  return static_cast<double>(n_two) / n;
}

TEST(EffectorStudy, SlantedFacesShowTwoTagsFromMostGrips) {
  EXPECT_LT(share_with_two_tags(EffectorBody::box), 0.5);
  EXPECT_GT(share_with_two_tags(EffectorBody::two_faces), 0.95);
}

TEST(EffectorStudy, FilmsWhatIsShipped) {
  for (const auto& [body, file] : {std::pair(EffectorBody::box, "effector.toml"),
                                   {EffectorBody::two_faces, "effector_two_faces.toml"}}) {
    EffectorPrint print;
    print.body = body;
    const MarkerBody filmed = bench_apparatus(640, print).effector;
    const MarkerBody shipped = load_effector(source_folder() + "/protocols/apparatus/" + file);
    EXPECT_EQ(filmed.size_m, shipped.size_m);
    EXPECT_EQ(filmed.chamfer_m, shipped.chamfer_m);
    ASSERT_EQ(filmed.tags.size(), shipped.tags.size());
    for (std::size_t i = 0; i < filmed.tags.size(); ++i) {
      EXPECT_EQ(filmed.tags[i].id, shipped.tags[i].id);
      for (std::size_t c = 0; c < 4; ++c)
        EXPECT_LT((filmed.tags[i].corners_m[c] - shipped.tags[i].corners_m[c]).norm(), 1e-9);
    }
  }
}

Apparatus without_effector_tags() {
  Apparatus apparatus = bench_apparatus(640);
  apparatus.effector.tags.clear();
  return apparatus;
}

Image board_picture() {
  SyntheticSettings settings;
  settings.optics.noise = 1;
  SyntheticCamera camera(bench_apparatus(640), settings, 1);
  return camera.picture([](double) { return std::nullopt; }, 0, 0);
}

// Every compared tracker finds every corner where the camera rendered it.
TEST(ComparisonTrackers, SeeTagsWhereTheyAre) {
  const Apparatus apparatus = without_effector_tags();
  const Image picture = board_picture();
  const Pose camera_from_board = SyntheticSettings().camera_from_board;
  for (const ComparisonEntry& entry : comparison_trackers()) {
    SCOPED_TRACE(std::string(entry.name));
    const auto tracker = entry.make(apparatus, 1);
    const ComparisonPoses poses = tracker->track(picture);
    EXPECT_GE(tracker->tags().size(), 22U);  // aruco overlooks one or two of the 24
    for (const DetectedTag& seen : tracker->tags()) {
      const Tag& tag = apparatus.board.tags.at(static_cast<std::size_t>(seen.id));
      for (std::size_t i = 0; i < 4; ++i) {
        const Eigen::Vector2d there =
            project(apparatus.camera, camera_from_board * tag.corners_m[i]);
        EXPECT_LT((seen.corners_px[i] - there).norm(), 2) << "tag " << seen.id << " corner " << i;
      }
    }
    ASSERT_TRUE(poses.camera_from_board);
    EXPECT_LT((poses.camera_from_board->position_m - camera_from_board.position_m).norm(), 0.02);
    EXPECT_LT(poses.camera_from_board->orientation.angularDistance(camera_from_board.orientation),
              0.05);
    EXPECT_FALSE(poses.camera_from_effector);
  }
}

TEST(ErrorOf, MeasuresTheTipInTheBoardsFrame) {
  const Pose truth{{0.1, 0, 0.03}, Eigen::Quaterniond::Identity()};
  MethodPoses poses{Pose{}, truth};
  poses.board_from_effector->orientation =
      Eigen::AngleAxisd(0.01, Eigen::Vector3d::UnitZ());  // 45 mm from the center: 0.45 mm
  const TrackedError error = error_of(poses, Pose{}, truth, {0.045, 0, 0});
  EXPECT_NEAR(*error.tip_mm, 0.45, 1e-3);
  EXPECT_NEAR(*error.effector_deg, 0.01 * 180 / M_PI, 1e-9);
  EXPECT_EQ(*error.board_mm, 0);
  EXPECT_FALSE(error_of({}, Pose{}, truth, {0, 0, 0}).tip_mm);
}

TEST(SummaryOf, CountsWhatWasNotFound) {
  std::vector<TrackedError> errors(4);
  errors[1].tip_mm = 2;
  errors[3].tip_mm = 4;
  const ErrorSummary summary = summary_of(errors);
  EXPECT_EQ(summary.effector_found, 0.5);
  EXPECT_EQ(summary.tip_mm.median, 3);
  EXPECT_FALSE(summary.board_mm.p95);
}

// A swipe's length is the integral of its speed, which is 0.5 m/s in the middle.
TEST(Take, SwipeIsAsFastAsItSays) {
  const Take swipe = take(Motion::swipe, 1, 0);
  EXPECT_NEAR(swipe.speed_m_s(0.22), 0.5, 1e-6);
  EXPECT_EQ(swipe.speed_m_s(-0.1), 0);
  EXPECT_EQ(swipe.speed_m_s(1), 0);
  const double way_m = (swipe.at(1).position_m - swipe.at(-1).position_m).norm();
  EXPECT_NEAR(way_m, 0.5 * (0.24 + 0.1), 1e-9);
  for (double t_s = 0; t_s < 0.44; t_s += 0.01)
    EXPECT_LT((swipe.at(t_s + 1e-3).position_m - swipe.at(t_s).position_m).norm(), 0.501e-3);
}

// Without measurement error, so that all errors are the filter's.
MethodFilm perfect_film(Motion motion, int n_pictures) {
  MethodFilm film;
  film.takes.push_back(take(motion, 1, 0));
  film.pictures.emplace_back();
  for (int i = 0; i < n_pictures; ++i) {
    const double t_s = i / film_rate_hz;
    const Pose truth = film.takes[0].at(t_s);
    film.pictures[0].push_back({t_s, truth, 2, {Pose{}, truth}, {}});
  }
  return film;
}

const SmootherEntry& smoother(const std::string& name) {
  for (const SmootherEntry& entry : smoothers())
    if (entry.name() == name) return entry;
  throw std::runtime_error("no filter " + name);
}

TEST(Filters, ExponentialTrailsAStrokeAsItsShareSays) {
  const MethodFilm film = perfect_film(Motion::swipe, 12);
  const auto takes = filtered(film, smoother("exponential, 0.4"));
  ASSERT_EQ(takes.size(), 1U);
  // Trailing a steady motion by (1 - share) / share pictures; at picture 10 of a swipe, 7 pictures
  // into its steady part, up to what is left of the start.
  const auto i = std::size_t{9};
  const double behind_m =
      (takes[0].poses[i].position_m - film.pictures[0][i].truth.position_m).norm();
  EXPECT_NEAR(behind_m, 0.5 * 1.5 / film_rate_hz, 0.1 * 0.5 * 1.5 / film_rate_hz);
}

TEST(Filters, NoneChangesNothingAndStillFilmHasNoJitter) {
  const MethodFilm film = perfect_film(Motion::hold, 30);
  const Eigen::Vector3d tip_m(0.045, 0, 0);
  for (const SmootherEntry& entry : smoothers())
    EXPECT_LT(*jitter_mm(filtered(film, entry), tip_m), 1e-6) << entry.name();
}

TEST(Filters, StartAfreshWhereTheEffectorWasLost) {
  MethodFilm film = perfect_film(Motion::stroke, 10);
  film.pictures[0][4].poses.board_from_effector.reset();
  const auto stretches = filtered(film, smoother("exponential, 0.2"));
  ASSERT_EQ(stretches.size(), 2U);
  EXPECT_EQ(stretches[0].poses.size(), 4U);
  EXPECT_EQ(stretches[1].poses.size(), 5U);
  EXPECT_EQ(stretches[1].poses[0].position_m, film.pictures[0][5].truth.position_m);
}

TEST(Goals, SayWhatIsMet) {
  EXPECT_TRUE((Goal{"", 1, "mm", false, 0.5}.met()));
  EXPECT_FALSE((Goal{"", 8, "times", true, 7.9}.met()));
  EXPECT_FALSE((Goal{"", 1, "mm", false, NAN}.met()));
}

}  // namespace
}  // namespace heft
