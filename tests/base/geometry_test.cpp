// Clipping of convex polygons.
#include "base/math/Geometry.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/Random.h"

namespace heft {
namespace {

using Eigen::Vector2d;
using Convex = Polygon<Vector2d, 9>;

struct Line {
  Vector2d normal;
  double offset;
  double above(const Vector2d& point) const { return normal.dot(point) - offset; }
};

Vector2d between(const Vector2d& from, const Vector2d& to, double s) {
  return from + s * (to - from);
}

Convex part_above(const Convex& polygon, const Line& line) {
  return clipped(
      polygon, [&](const Vector2d& corner) { return line.above(corner); }, between);
}

double area(const Convex& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return twice / 2;
}

// Corners on a circle, in order.
Convex random_polygon(RandomStream& draws) {
  std::vector<double> angles;
  for (std::uint64_t n = 3 + draws.below(6); angles.size() < n;)
    angles.push_back(2 * std::numbers::pi * draws.uniform());
  std::ranges::sort(angles);
  Convex polygon;
  for (const double angle : angles) polygon.add({std::cos(angle), std::sin(angle)});
  return polygon;
}

Line random_line(RandomStream& draws) {
  const double angle = 2 * std::numbers::pi * draws.uniform();
  return {{std::cos(angle), std::sin(angle)}, 2.4 * draws.uniform() - 1.2};
}

RC_GTEST_PROP(Clipping, TheTwoSidesOfALineHaveTheWholesArea, (std::uint64_t seed)) {
  RandomStream draws(seed, "clipping");
  const Convex whole = random_polygon(draws);
  const Line line = random_line(draws);
  const Convex kept = part_above(whole, line);
  const Convex cut_off = part_above(whole, {-line.normal, -line.offset});
  RC_ASSERT(std::abs(area(kept) + area(cut_off) - area(whole)) < 1e-12);
  RC_CLASSIFY(!kept.empty() && !cut_off.empty());
}

RC_GTEST_PROP(Clipping, KeepsThisSideOnlyAndGainsOneCornerAtMost, (std::uint64_t seed)) {
  RandomStream draws(seed, "clipping");
  const Convex whole = random_polygon(draws);
  const Line line = random_line(draws);
  const Convex kept = part_above(whole, line);
  RC_ASSERT(kept.size() <= whole.size() + 1);
  for (const Vector2d& corner : kept) RC_ASSERT(line.above(corner) > -1e-12);
}

RC_GTEST_PROP(Clipping, TheOrderOfCutsDoesNotMatter, (std::uint64_t seed)) {
  RandomStream draws(seed, "clipping");
  Convex whole = random_polygon(draws);
  whole.keep_first(5);
  const Line one = random_line(draws), other = random_line(draws);
  const double first = area(part_above(part_above(whole, one), other));
  RC_ASSERT(std::abs(first - area(part_above(part_above(whole, other), one))) < 1e-12);
}

TEST(Clipping, AnUncutPolygonStaysAsItIs) {
  const std::array<Vector2d, 4> square{Vector2d(0, 0), {1, 0}, {1, 1}, {0, 1}};
  const Convex kept = part_above(Convex(square), {Vector2d::UnitX(), 0});
  EXPECT_TRUE(std::ranges::equal(kept, square));
  EXPECT_TRUE(part_above(Convex(square), {Vector2d::UnitX(), 1.5}).empty());
}

TEST(Clipping, WhatACornerCarriesIsCutWithIt) {
  struct Shade {
    double x, dark;
  };
  Polygon<Shade, 4> line;
  line.add({-1, 0.2});
  line.add({3, 1.0});
  const auto kept = clipped(
      line, [](const Shade& s) { return s.x; },
      [](const Shade& from, const Shade& to, double s) -> Shade {
        return {from.x + s * (to.x - from.x), from.dark + s * (to.dark - from.dark)};
      });
  ASSERT_EQ(kept.size(), 3u);  // in from the left, the far end, and back
  EXPECT_DOUBLE_EQ(kept[0].x, 0);
  EXPECT_DOUBLE_EQ(kept[0].dark, 0.4);
}

TEST(Polygon, LeavesOutWhatItHasNoRoomFor) {
  Polygon<int, 2> pair;
  for (int i = 0; i < 5; ++i) pair.add(i);
  ASSERT_EQ(pair.size(), 2u);
  EXPECT_EQ(pair[1], 1);
}

}  // namespace
}  // namespace heft
