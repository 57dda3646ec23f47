// Poses, boxes, names, text and hashes.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "base/Clock.h"
#include "base/Error.h"
#include "base/Names.h"
#include "base/Pose.h"
#include "base/Program.h"
#include "base/Random.h"
#include "base/files/TextFile.h"
#include "base/math/Geometry.h"

namespace heft {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Optional;

Pose random_pose(RandomStream& stream, double reach_m) {
  const auto draw = [&] { return 2 * stream.uniform() - 1; };
  return {reach_m * Eigen::Vector3d(draw(), draw(), draw()),
          Eigen::Quaterniond(draw(), draw(), draw(), draw()).normalized()};
}

TEST(Pose, RotationVectorsAndRotationsAreInverseFromTinyToHalfATurn) {
  for (double angle_rad : {1e-15, 1e-9, 1e-4, 0.3, 2.0, std::numbers::pi - 1e-6}) {
    const Eigen::Vector3d vector = angle_rad * Eigen::Vector3d(1, -2, 2) / 3;
    const Eigen::Vector3d back = rotation_vector(rotation_from_vector(vector));
    EXPECT_LT((back - vector).norm(), 1e-12 * (1 + angle_rad)) << angle_rad;
  }
}

TEST(Pose, MeanVelocityTakesOnePoseToTheOther) {
  RandomStream stream(1, "poses");
  for (int i = 0; i < 100; ++i) {
    const Pose from = random_pose(stream, 0.1), to = random_pose(stream, 0.1);
    const Velocity velocity = mean_velocity(from, to, 0.1);
    const Eigen::Quaterniond turned =
        rotation_from_vector(0.1 * velocity.angular_rad_s) * from.orientation;
    EXPECT_LT((from.position_m + 0.1 * velocity.linear_m_s - to.position_m).norm(), 1e-12);
    EXPECT_LT(turned.angularDistance(to.orientation), 1e-7);
  }
}

TEST(Boxes, OverlapAgreesWithASearchForACommonPoint) {
  // A point of one box inside the other proves overlap; boxes that overlap by a margin have one on
  // a grid of that spacing.
  RandomStream stream(2, "boxes");
  const Eigen::Vector3d size_a(0.09, 0.04, 0.04), size_b(0.035, 0.035, 0.035);
  int n_overlaps = 0;
  for (int i = 0; i < 400; ++i) {
    const Pose a = random_pose(stream, 0.04), b = random_pose(stream, 0.04);
    const auto grid_point_of_b_in_a = [&](const Eigen::Vector3d& reach_m) {
      for (int x = -8; x <= 8; ++x)
        for (int y = -8; y <= 8; ++y)
          for (int z = -8; z <= 8; ++z) {
            const Eigen::Vector3d point = b * (Eigen::Vector3d(x, y, z).cwiseProduct(size_b) / 16);
            const Eigen::Vector3d in_a = a.orientation.conjugate() * (point - a.position_m);
            if ((in_a.cwiseAbs() - reach_m).maxCoeff() <= 0) return true;
          }
      return false;
    };
    const bool overlap = boxes_overlap(a, size_a, b, size_b);
    if (grid_point_of_b_in_a(size_a / 2)) {
      EXPECT_TRUE(overlap);
    }
    // Grid spacing 2.2 mm: if they overlap, a grid point is within its diagonal of box a.
    if (overlap) {
      EXPECT_TRUE(grid_point_of_b_in_a(size_a / 2 + Eigen::Vector3d::Constant(0.002)));
    }
    n_overlaps += overlap;
  }
  EXPECT_GT(n_overlaps, 50);
  EXPECT_LT(n_overlaps, 350);
}

TEST(Boxes, TouchingCountsAsOverlapping) {
  const Pose a, b{{1, 0, 0}, Eigen::Quaterniond::Identity()};
  EXPECT_TRUE(boxes_overlap(a, {1, 1, 1}, b, {1, 1, 1}));
  EXPECT_FALSE(boxes_overlap(a, {1, 1, 1}, b, {0.999, 1, 1}));
}

TEST(Names, TheNearestNameIsFoundIfItIsNearEnough) {
  constexpr std::array<std::string_view, 3> names{"friction", "gravity_m_s2", "simulator"};
  EXPECT_THAT(nearest_name("fricton", names), Optional(std::string("friction")));
  EXPECT_THAT(nearest_name("simulatr", names), Optional(std::string("simulator")));
  EXPECT_EQ(nearest_name("xyzzy", names), std::nullopt);
}

TEST(Text, CellsLinesAndNumbers) {
  EXPECT_THAT(lines_of("a\r\nb\n\nc"), ElementsAre("a", "b", "", "c"));
  EXPECT_THAT(cells_of(" 1 ,,x"), ElementsAre("1", "", "x"));
  EXPECT_THAT(number_in("-1.5e-3"), Optional(-1.5e-3));
  EXPECT_THAT(number_in("+2"), Optional(2.0));
  for (const char* text : {"", "1,5", "1.5x", "nan", "inf", "1e999", "0x10", "++1"})
    EXPECT_EQ(number_in(text), std::nullopt) << text;
}

TEST(Text, AByteOrderMarkIsNoPartOfTheFirstLine) {
  EXPECT_THAT(lines_of("\xEF\xBB\xBF"
                       "t_s,x_m\r\n\xEF\xBB\xBF"),
              ElementsAre("t_s,x_m", "\xEF\xBB\xBF"));
  EXPECT_THAT(lines_of("\xEF\xBB\xBF"), ElementsAre());
}

TEST(Text, AnUnreadableFileIsNamedWithTheReason) {
  try {
    read_text_file("no/such/file");
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("no/such/file: No such file"));
  }
}

TEST(Sha256, GivesTheStandardDigestOfAbc) {  // FIPS 180-2, appendix B.1
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

// A machine with an empty clock battery may have such times.
TEST(Build, TimesBefore1970AreReadBack) {
  const auto at = [](std::chrono::milliseconds since_1970) {
    return utc_of(std::chrono::system_clock::time_point(since_1970));
  };
  using std::chrono::milliseconds;
  EXPECT_EQ(at(milliseconds(-1)), "1969-12-31T23:59:59.999Z");
  EXPECT_EQ(at(milliseconds(-1000)), "1969-12-31T23:59:59.000Z");
  EXPECT_EQ(at(milliseconds(1001)), "1970-01-01T00:00:01.001Z");
  EXPECT_NEAR(seconds_since(at(milliseconds(-1500))) - seconds_since(at(milliseconds(500))), 2, .1);
  // The format of earlier logs.
  EXPECT_NEAR(seconds_since("1969-12-31T23:59:59.-500Z") - seconds_since(at(milliseconds(0))), 1.5,
              .1);
}

TEST(Build, TimesInUtcAreReadBack) {
  EXPECT_NEAR(seconds_since(utc_now()), 0, 5);
  EXPECT_NEAR(seconds_since("2026-01-01T00:00:00.500Z") - seconds_since("2026-01-01T00:01:00.250Z"),
              59.75, 0.1);
  EXPECT_THROW(seconds_since("yesterday"), Error);
  EXPECT_THROW(seconds_since("2026-01-01T00:00:00.-Z"), Error);
  EXPECT_THAT(build_name(), HasSubstr("build "));
}

}  // namespace
}  // namespace heft
