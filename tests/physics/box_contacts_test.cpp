#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <set>

#include "physics/scene/BoxContacts.h"

namespace heft {
namespace {

const Eigen::Vector3d cube_size_m{0.04, 0.04, 0.04};

Box cube_at(double x_m, double y_m, double z_m,
            const Eigen::Quaterniond& turn = Eigen::Quaterniond::Identity()) {
  return box_at({{x_m, y_m, z_m}, turn}, cube_size_m);
}

Eigen::Quaterniond turn(double angle_rad, const Eigen::Vector3d& axis) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, axis.normalized()));
}

TEST(BoxContacts, FacesApartMeetAtTheFourCornersOfTheirOverlap) {
  const Contact contact = contact_between(cube_at(0, 0, 0), cube_at(0.041, 0.01, 0), 0.002);
  ASSERT_EQ(contact.n_points, 4);
  EXPECT_TRUE(contact.normal.isApprox(Eigen::Vector3d(-1, 0, 0)));
  std::set<std::pair<int, int>> corners_mm;
  for (const ContactPoint& point : contact.all()) {
    EXPECT_NEAR(point.distance_m, 0.001, 1e-12);
    EXPECT_NEAR(point.on_first_m.x(), 0.020, 1e-12);
    EXPECT_NEAR(point.on_second_m.x(), 0.021, 1e-12);
    corners_mm.emplace(std::lround(point.on_first_m.y() * 1e3),
                       std::lround(point.on_first_m.z() * 1e3));
  }
  EXPECT_EQ(corners_mm,
            (std::set<std::pair<int, int>>{{-10, -20}, {-10, 20}, {20, -20}, {20, 20}}));
}

TEST(BoxContacts, NothingWhenFartherThanTheMarginOrBesideEachOther) {
  EXPECT_EQ(contact_between(cube_at(0, 0, 0), cube_at(0.043, 0, 0), 0.002).n_points, 0);
  EXPECT_EQ(contact_between(cube_at(0, 0, 0), cube_at(0.041, 0.041, 0), 0.002).n_points, 0);
}

TEST(BoxContacts, CrossedEdgesMeetInOnePoint) {
  const Box lower = cube_at(0, 0, 0, turn(M_PI / 4, Eigen::Vector3d::UnitX()));
  const Box upper =
      cube_at(0, 0, 0.04 * std::sqrt(2) - 0.001, turn(M_PI / 4, Eigen::Vector3d::UnitY()));
  const Contact contact = contact_between(upper, lower, 0.002);
  ASSERT_EQ(contact.n_points, 1);
  EXPECT_TRUE(contact.normal.isApprox(Eigen::Vector3d::UnitZ(), 1e-9));
  EXPECT_NEAR(contact.points[0].distance_m, -0.001, 1e-12);
  EXPECT_NEAR(contact.points[0].on_second_m.z(), 0.02 * std::sqrt(2), 1e-12);
}

// 80 mm away and offset: the nearest faces are the sides, but the front will be hit.
TEST(BoxContacts, OnTheWayFindsTheFaceThatWillBeHit) {
  const Box still = cube_at(0, 0, 0), coming = cube_at(-0.12, -0.045, 0);
  const Eigen::Vector3d travel_m(0.1, 0.01, 0);
  const Contact contact = contact_on_the_way(coming, still, travel_m, 0.001);
  ASSERT_EQ(contact.n_points, 4);
  EXPECT_TRUE(contact.normal.isApprox(Eigen::Vector3d(-1, 0, 0)));
  for (const ContactPoint& point : contact.all()) {
    EXPECT_NEAR(point.distance_m, 0.08, 1e-12);
    EXPECT_NEAR(point.on_first_m.x(), -0.1, 1e-12);
  }
  EXPECT_EQ(contact_on_the_way(coming, still, -travel_m, 0.001).n_points, 0);
  EXPECT_EQ(contact_on_the_way(coming, still, {0.1, -0.01, 0}, 0.001).n_points, 0);
}

TEST(BoxContacts, ABoxStandsOnTheTableWithItsLowestCorners) {
  const Contact contact = contact_with_table(cube_at(0.1, 0, 0.0195), 0.001);
  ASSERT_EQ(contact.n_points, 4);
  for (const ContactPoint& point : contact.all()) EXPECT_NEAR(point.distance_m, -0.0005, 1e-12);
  const Box on_edge = cube_at(0, 0, 0.02 * std::sqrt(2), turn(M_PI / 4, Eigen::Vector3d::UnitY()));
  EXPECT_EQ(contact_with_table(on_edge, 0.001).n_points, 2);
  EXPECT_EQ(contact_with_table(cube_at(0, 0, 0.022), 0.001).n_points, 0);
}

// Any two boxes: points are on their surfaces within rounding, distances are consistent, and
// exchanging the boxes reverses the normal.
RC_GTEST_PROP(BoxContacts, PointsDistancesAndNormalsAgree, ()) {
  const auto unit = [] { return *rc::gen::inRange(-1000, 1001) / 1000.0; };
  const auto direction = [&] { return Eigen::Vector3d(unit(), unit(), 1.5 + unit()); };
  const Box a =
      box_at({Eigen::Vector3d::Zero(), turn(3 * unit(), direction())}, {0.09, 0.04, 0.03});
  const Box b = box_at(
      {0.05 * Eigen::Vector3d(unit(), unit(), unit()), turn(3 * unit(), direction())}, cube_size_m);
  const Contact contact = contact_between(a, b, 0.003);
  RC_ASSERT(std::abs(contact.normal.norm() - 1) < 1e-12);
  for (const ContactPoint& point : contact.all()) {
    const Eigen::Vector3d apart_m = point.on_first_m - point.on_second_m;
    RC_ASSERT((apart_m - point.distance_m * contact.normal).norm() < 1e-9);
    RC_ASSERT(point.distance_m < 0.003);
  }
  const Contact swapped = contact_between(b, a, 0.003);
  RC_ASSERT((swapped.n_points > 0) == (contact.n_points > 0));
}

TEST(Parting, IsWhereTheBoxesNoLongerOverlap) {
  const Box still = box_at(Pose{}, {0.04, 0.04, 0.04});
  const Box beside =
      box_at({{-0.039, 0.03, 0}, Eigen::Quaterniond::Identity()}, {0.04, 0.04, 0.04});
  const auto share = parting(beside, still, {0, 0.02, 0});
  ASSERT_TRUE(share.has_value());
  EXPECT_NEAR(*share, 0.5, 1e-12);
  EXPECT_FALSE(parting(beside, still, {0, 0.005, 0}).has_value());  // not within the travel
  EXPECT_FALSE(parting(beside, still, {0, 0, 0}).has_value());
  const Box apart = box_at({{-0.05, 0.03, 0}, Eigen::Quaterniond::Identity()}, {0.04, 0.04, 0.04});
  EXPECT_FALSE(parting(apart, still, {0, 0.02, 0}).has_value());
}

}  // namespace
}  // namespace heft
