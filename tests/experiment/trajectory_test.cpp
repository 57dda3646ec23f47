#include "experiment/Trajectory.h"

#include <gmock/gmock.h>

#include <numbers>

#include "base/Error.h"
#include "base/Random.h"
#include "experiment/Event.h"

namespace heft {
namespace {

using ::testing::HasSubstr;

const std::string header = "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n";

std::string mistakes_of(const std::string& text) {
  try {
    parse_trajectory(text, "hand.csv");
  } catch (const InvalidFile& error) {
    return error.what();
  }
  return "";
}

TEST(Trajectory, IsInterpolatedBetweenRowsAndConstantOutside) {
  const Trajectory hand =
      parse_trajectory(header + "1,0,0,0,1,0,0,0\n3,0.2,0,0.4,0,0,0,1\n", "hand.csv");
  EXPECT_EQ(hand.start_s(), 1);
  EXPECT_EQ(hand.end_s(), 3);
  const Pose middle = hand.at(2).value();
  EXPECT_TRUE(middle.position_m.isApprox(Eigen::Vector3d(0.1, 0, 0.2)));
  EXPECT_NEAR(middle.orientation.angularDistance(Eigen::Quaterniond::Identity()),
              std::numbers::pi / 2, 1e-12);
  EXPECT_EQ(hand.at(0)->position_m, Eigen::Vector3d::Zero());
  EXPECT_EQ(hand.at(9)->position_m, Eigen::Vector3d(0.2, 0, 0.4));
}

TEST(Trajectory, BlankPosesAreOutOfView) {
  const Trajectory hand =
      parse_trajectory(header + "0,0,0,0,1,0,0,0\n1,,,,,,,\n2,0,0,0,1,0,0,0\n", "hand.csv");
  EXPECT_TRUE(hand.at(0));
  EXPECT_FALSE(hand.at(0.5));
  EXPECT_FALSE(hand.at(1.5));
  EXPECT_TRUE(hand.at(2));
}

TEST(Trajectory, EveryMistakeIsReportedAtItsPlace) {
  const std::string said = mistakes_of(header + "0,0,0,0,1,0,0,0\n" +  //
                                       "1,0,oops,0,1,0,0,0\n" +        // column 5
                                       "2,0,0\n" +                     // too few
                                       "0,0,0,0,1,0,0,0\n" +           // does not come after
                                       "3,0,0,0,2,0,0,0\n" +           // no unit quaternion
                                       "4,0,0,0,1,0,0,inf\n");
  EXPECT_THAT(said, HasSubstr("hand.csv:3:5: y_m is \"oops\", expected a finite number"));
  EXPECT_THAT(said, HasSubstr("hand.csv:4:1: 3 cells, expected 8"));
  EXPECT_THAT(mistakes_of("t_s,x_m,y_m,z_m,qw,qx,qy,qz\n0,,0,0,1,0,0,0\n"),
              HasSubstr("hand.csv:2:3: x_m is \"\", expected a finite number"));
  EXPECT_THAT(said, HasSubstr("hand.csv:5:1: t_s 0 does not come after"));
  EXPECT_THAT(said, HasSubstr("hand.csv:6:9: qw,qx,qy,qz has length 2"));
  EXPECT_THAT(said, HasSubstr("hand.csv:7:15: qz is \"inf\""));
  EXPECT_THAT(mistakes_of("x,y\n"), HasSubstr("hand.csv:1:1: expected the header t_s,x_m"));
  EXPECT_THAT(mistakes_of(header), HasSubstr("no rows"));
  EXPECT_THAT(mistakes_of(""), HasSubstr("hand.csv:1:1"));
}

TEST(Trajectory, DamagedFilesNeverCrash) {
  const std::string good = header + "0,0,0,0,1,0,0,0\n0.5,0.1,0.2,0.3,0.6,0,0.8,0\n";
  RandomStream stream(1, "damage");
  int n_refused = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string text = good;
    for (std::uint64_t n = 1 + stream.below(4); n > 0; --n) {
      const auto at = stream.below(text.size());
      if (stream.coin(0.3))
        text.erase(at, 1 + stream.below(10));
      else
        text[at] = static_cast<char>(stream.below(256));
      if (text.empty()) break;
    }
    n_refused += !mistakes_of(text).empty();
  }
  EXPECT_GT(n_refused, 10000);
  EXPECT_LT(n_refused, 20000);
}

TEST(Trajectory, OutOfRangeNumbersAreRefused) {
  const auto refused = [](const std::string& row) { return mistakes_of(header + row + "\n"); };
  EXPECT_EQ(refused("0,-1e6,1e6,0,1,0,0,0"), "");
  for (const std::string far : {"1e308", "-1e308", "1000001"})
    EXPECT_EQ(refused("0,0," + far + ",0,1,0,0,0").find("hand.csv:2:5: y_m is "), 0u) << far;
  EXPECT_EQ(refused("1e308,0,0,0,1,0,0,0").find("hand.csv:2:1: t_s is "), 0u);
}

TEST(LogTime, DurationsDoNotDependOnTime) {
  RandomStream stream(2, "times");
  for (int i = 0; i < 1000; ++i) {
    const double start_s = log_time(1e4 * stream.uniform()), span_s = log_time(stream.uniform());
    EXPECT_EQ((start_s + span_s) - start_s, span_s);
    EXPECT_NEAR(log_time(start_s + 1e-7), start_s, 1e-6);
  }
}

}  // namespace
}  // namespace heft
