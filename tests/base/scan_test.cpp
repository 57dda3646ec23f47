// Points and areas of a grid that a polygon covers.
#include "base/math/Scan.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "base/Random.h"

namespace heft {
namespace {

using Eigen::Vector2d;
using Triangle = std::array<Vector2d, 3>;

constexpr int n_columns = 24, n_rows = 18;

// A value for each square or point of the grid.
struct Grid {
  std::vector<double> values = std::vector<double>(n_columns * n_rows);
  double& at(int x, int y) { return values[static_cast<std::size_t>(y * n_columns + x)]; }
  double sum() const {
    double total = 0;
    for (const double value : values) total += value;
    return total;
  }
};

Grid points_of(const Triangle& triangle) {
  Grid hits;
  scan_points(triangle, n_columns, n_rows, [&](int y, int begin, int end) {
    for (int x = begin; x < end; ++x) ++hits.at(x, y);
  });
  return hits;
}

Grid areas_of(std::span<const Vector2d> polygon, const Vector2d& grid = {0, 0}) {
  Grid covered;
  scan_areas(polygon, grid, n_columns, n_rows, [&](int y, int from, double change) {
    for (int x = from; x < n_columns; ++x) covered.at(x, y) += change;
  });
  return covered;
}

double cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// Clockwise, y down. @param beyond how far outside of the grid its corners may be
Triangle random_triangle(RandomStream& draws, double beyond) {
  Triangle t;
  for (Vector2d& corner : t)
    corner = {(n_columns + 2 * beyond) * draws.uniform() - beyond,
              (n_rows + 2 * beyond) * draws.uniform() - beyond};
  if (cross(t[1] - t[0], t[2] - t[0]) < 0) std::swap(t[1], t[2]);
  return t;
}

double depth_in(const Triangle& t, const Vector2d& p) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector2d side = t[(i + 1) % 3] - t[i];
    least = std::min(least, cross(side, p - t[i]) / side.norm());
  }
  return least;
}

RC_GTEST_PROP(Scan, FindsThePointsThatATriangleHoldsAndNoOthers, (std::uint64_t seed)) {
  RandomStream draws(seed, "triangle");
  const Triangle t = random_triangle(draws, 30);
  Grid hits = points_of(t);
  for (int y = 0; y < n_rows; ++y) {
    for (int x = 0; x < n_columns; ++x) {
      const double depth = depth_in(t, Vector2d(x, y));
      if (std::abs(depth) < 1e-9) continue;  // on an edge: one side's or the other's
      RC_ASSERT(hits.at(x, y) == (depth > 0 ? 1 : 0));
    }
  }
}

// Corners may lie on points, and edges may pass through points, which must be counted exactly once.
RC_GTEST_PROP(Scan, TrianglesWithAnEdgeInCommonPartThePointsBetweenThem, ()) {
  const auto point = [] {
    return Vector2d(*rc::gen::inRange(-4, n_columns + 4), *rc::gen::inRange(-4, n_rows + 4));
  };
  const Vector2d a = point(), b = point(), c = point(), d = point();
  RC_PRE(cross(b - a, c - a) * cross(b - a, d - a) < 0);  // on either side of the edge from a to b
  Grid first = points_of({a, b, c}), second = points_of({b, a, d});
  for (std::size_t i = 0; i < first.values.size(); ++i)
    RC_ASSERT(first.values[i] + second.values[i] <= 1);
  for (int y = 0; y < n_rows; ++y) {
    for (int x = 0; x < n_columns; ++x) {
      const Vector2d p(x, y);
      const double along = (p - a).dot(b - a) / (b - a).squaredNorm();
      if (cross(b - a, p - a) != 0 || along <= 0 || along >= 1) continue;
      RC_ASSERT(first.at(x, y) + second.at(x, y) == 1);  // a point of the common edge itself
    }
  }
}

RC_GTEST_PROP(Scan, CoverageSumsToThePolygonsAreaAndIsNeverMoreThanAll, (std::uint64_t seed)) {
  RandomStream draws(seed, "triangle");
  const Triangle t = random_triangle(draws, 0);
  const Grid covered = areas_of(t);
  for (const double fraction : covered.values) RC_ASSERT(fraction > -1e-12 && fraction < 1 + 1e-12);
  RC_ASSERT(std::abs(covered.sum() - cross(t[1] - t[0], t[2] - t[0]) / 2) < 1e-9);
}

RC_GTEST_PROP(Scan, CoverageIsTheFractionThatManyPointsFind, (std::uint64_t seed)) {
  constexpr int n = 40;
  RandomStream draws(seed, "triangle");
  const Triangle t = random_triangle(draws, 10);
  const int x = *rc::gen::inRange(0, n_columns), y = *rc::gen::inRange(0, n_rows);
  int inside = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) inside += depth_in(t, {x + (i + 0.5) / n, y + (j + 0.5) / n}) > 0;
  Grid covered = areas_of(t);
  RC_ASSERT(std::abs(covered.at(x, y) - static_cast<double>(inside) / (n * n)) < 0.05);
}

RC_GTEST_PROP(Scan, WhatLiesBesideTheGridIsCutOff, (std::uint64_t seed)) {
  RandomStream draws(seed, "triangle");
  const Triangle t = random_triangle(draws, 40);
  const int right = *rc::gen::inRange(0, 8), down = *rc::gen::inRange(0, 8);
  Grid here = areas_of(t), there = areas_of(t, Vector2d(right, down));
  for (int y = 0; y + down < n_rows; ++y)
    for (int x = 0; x + right < n_columns; ++x)
      RC_ASSERT(std::abs(there.at(x, y) - here.at(x + right, y + down)) < 1e-9);
}

RC_GTEST_PROP(Scan, ATurnedPolygonTakesAwayWhatItAdds, (std::uint64_t seed)) {
  RandomStream draws(seed, "triangle");
  const Triangle t = random_triangle(draws, 10);
  const Grid added = areas_of(t), taken = areas_of(Triangle{t[2], t[1], t[0]});
  for (std::size_t i = 0; i < added.values.size(); ++i)
    RC_ASSERT(std::abs(added.values[i] + taken.values[i]) < 1e-12);
}

TEST(Scan, PlacesThatAreNoNumbersTouchNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(points_of({Vector2d(nan, nan), Vector2d(nan, nan), Vector2d(nan, nan)}).sum(), 0);
  EXPECT_EQ(areas_of(Triangle{Vector2d(3, nan), Vector2d(5, nan), Vector2d(4, nan)}).sum(), 0);
  EXPECT_EQ(areas_of({}).sum(), 0);
}

}  // namespace
}  // namespace heft
