#include <gtest/gtest.h>

#include <cmath>

#include "base/Pose.h"
#include "base/Random.h"
#include "tracking/pose/PoseFilter.h"

namespace heft {
namespace {

constexpr double dt_s = 1.0 / 30;
constexpr double noise_m = 0.0002, noise_rad = 0.002;

Pose noisy(const Pose& pose, RandomStream& random) {
  const auto draw = [&](double sd) {
    return Eigen::Vector3d(sd * random.normal(), sd * random.normal(), sd * random.normal());
  };
  return {pose.position_m + draw(noise_m),
          rotation_from_vector(draw(noise_rad)) * pose.orientation};
}

TEST(PoseFilter, GivesTheFirstPoseBackAtRest) {
  PoseFilter filter;
  const Pose pose = upright_pose({.1, .2, .3}, 1);
  const FilteredPose first = filter.update(5, pose, 1);
  EXPECT_EQ(first.pose.position_m, pose.position_m);
  EXPECT_EQ(first.velocity.linear_m_s.norm(), 0);
}

TEST(PoseFilter, CalmsAStillEffector) {
  PoseFilter filter;
  RandomStream random(1, "filter");
  const Pose pose = upright_pose({.1, .2, .03}, 1);
  double raw = 0, filtered = 0, turn = 0;
  for (int i = 0; i < 600; ++i) {
    const Pose measured = noisy(pose, random);
    const FilteredPose now = filter.update(i * dt_s, measured, 1);
    if (i < 60) continue;
    raw += (measured.position_m - pose.position_m).squaredNorm();
    filtered += (now.pose.position_m - pose.position_m).squaredNorm();
    turn = std::max(turn, now.pose.orientation.angularDistance(pose.orientation));
  }
  EXPECT_LT(std::sqrt(filtered), 0.6 * std::sqrt(raw));
  EXPECT_LT(turn, 0.006);
}

TEST(PoseFilter, DoesNotLagBehindSteadyMotion) {
  PoseFilter filter;
  FilteredPose now;
  Pose pose;
  for (int i = 0; i < 60; ++i) {
    pose = {{0.5 * i * dt_s, 0, 0}, rotation_from_vector({0, 0, 2.0 * i * dt_s})};
    now = filter.update(i * dt_s, pose, 1);
  }
  EXPECT_LT((now.pose.position_m - pose.position_m).norm(), 5e-5);
  EXPECT_LT(now.pose.orientation.angularDistance(pose.orientation), 1e-3);
  EXPECT_NEAR(now.velocity.linear_m_s.x(), 0.5, 0.005);
  EXPECT_NEAR(now.velocity.angular_rad_s.z(), 2, 0.02);
}

TEST(PoseFilter, FollowsAHandThatStartsAndStopsAtOnce) {
  // Minimum-jerk reaches of 20 cm in 0.6 s (Flash & Hogan 1985), peak 0.63 m/s, with rests between.
  PoseFilter filter;
  RandomStream random(2, "filter");
  double worst_m = 0;
  for (int i = 0; i < 300; ++i) {
    const double phase = std::fmod(i * dt_s, 2.0);
    const double s = std::clamp(phase / 0.6, 0.0, 1.0);
    const double way = 0.2 * s * s * s * (10 - 15 * s + 6 * s * s);
    const double x = std::fmod(i * dt_s, 4.0) < 2 ? way : 0.2 - way;
    const Pose pose{{x, 0, 0}, Eigen::Quaterniond::Identity()};
    const FilteredPose now = filter.update(i * dt_s, noisy(pose, random), 1);
    worst_m = std::max(worst_m, (now.pose.position_m - pose.position_m).norm());
  }
  EXPECT_LT(worst_m, 0.001);
}

TEST(PoseFilter, VelocityIsNotLateInAStroke) {
  // To and fro at 0.4 m/s in the middle, predicted by 50 ms as for see-through glasses. A velocity
  // that lags by half a picture would give 3.15 mm.
  constexpr double reach_m = 0.07, ahead_s = 0.05;
  const auto x_at = [](double t_s) { return reach_m * std::sin(0.4 / reach_m * t_s); };
  PoseFilter filter;
  RandomStream random(4, "filter");
  double sum = 0;
  int n = 0;
  for (int i = 0; i < 600; ++i) {
    const double t_s = i * dt_s;
    const Pose pose{{x_at(t_s), 0, 0}, Eigen::Quaterniond::Identity()};
    const FilteredPose now = filter.update(t_s, noisy(pose, random), 1);
    if (i < 10) continue;
    const Eigen::Vector3d ahead_m = now.pose.position_m + ahead_s * now.velocity.linear_m_s;
    sum += (ahead_m - Eigen::Vector3d(x_at(t_s + ahead_s), 0, 0)).squaredNorm();
    ++n;
  }
  EXPECT_LT(std::sqrt(sum / n), 0.0029);
}

TEST(PoseFilter, TrustsABadMeasurementLess) {
  PoseFilter good, bad;
  const Pose still;
  for (int i = 0; i < 60; ++i) {
    good.update(i * dt_s, still, 1);
    bad.update(i * dt_s, still, 1);
  }
  const Pose off{{0.0003, 0, 0}, Eigen::Quaterniond::Identity()};
  EXPECT_GT(good.update(2, off, 1).pose.position_m.x(),
            2 * bad.update(2, off, 0.3).pose.position_m.x());
}

TEST(PoseFilter, ForgetsOnReset) {
  PoseFilter filter;
  filter.update(0, {}, 1);
  filter.reset();
  const Pose there = upright_pose({1, 0, 0}, 0);
  EXPECT_EQ(filter.update(0.03, there, 1).pose.position_m, there.position_m);
}

}  // namespace
}  // namespace heft
