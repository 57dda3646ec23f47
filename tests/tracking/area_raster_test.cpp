#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>

#include "base/Random.h"
#include "tracking/synthetic/AreaRaster.h"

namespace heft {
namespace {

using Eigen::Vector2d;
using Triangle = std::array<Vector2d, 3>;

const Light white(1, 1, 1, 1);

LightPicture drawn(const Triangle& triangle, const PixelBox& box) {
  AreaRaster raster;
  raster.begin(box);
  raster.add(triangle, white);
  LightPicture picture(box);
  raster.draw_behind(picture);
  return picture;
}

double cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// Clockwise in the picture, whose y points down.
Triangle random_triangle(double low, double high) {
  RandomStream random(*rc::gen::arbitrary<std::uint64_t>(), "triangle");
  Triangle t;
  for (Vector2d& corner : t)
    for (double& coordinate : corner) coordinate = low + (high - low) * random.uniform();
  if (cross(t[1] - t[0], t[2] - t[0]) < 0) std::swap(t[1], t[2]);
  return t;
}

bool holds(const Triangle& t, const Vector2d& p) {
  for (std::size_t i = 0; i < 3; ++i)
    if (cross(t[(i + 1) % 3] - t[i], p - t[i]) < 0) return false;
  return true;
}

RC_GTEST_PROP(AreaRaster, CoversATrianglesAreaAndNoPixelTwice, ()) {
  const Triangle t = random_triangle(0, 20);
  const double area = cross(t[1] - t[0], t[2] - t[0]) / 2;
  const LightPicture picture = drawn(t, {-1, -1, 22, 22});
  double sum = 0;
  for (int y = -1; y < 22; ++y) {
    for (int x = -1; x < 22; ++x) {
      const double coverage = picture.row(y)[x + 1][3];
      RC_ASSERT(coverage > -1e-4 && coverage < 1 + 1e-4);
      sum += coverage;
    }
  }
  RC_ASSERT(std::abs(sum - area) < 1e-3);
}

RC_GTEST_PROP(AreaRaster, GivesAPixelTheShareThatSamplesFind, ()) {
  constexpr int n = 40;
  const Triangle t = random_triangle(0, 6);
  const LightPicture picture = drawn(t, {0, 0, 7, 7});
  const int x = *rc::gen::inRange(0, 7), y = *rc::gen::inRange(0, 7);
  int inside = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      inside += holds(t, {x - 0.5 + (i + 0.5) / n, y - 0.5 + (j + 0.5) / n});
  RC_ASSERT(std::abs(picture.row(y)[x][3] - static_cast<double>(inside) / (n * n)) < 0.05);
}

RC_GTEST_PROP(AreaRaster, CutsOffWhatLiesOutsideItsBox, ()) {
  const Triangle t = random_triangle(-10, 30);
  const LightPicture whole = drawn(t, {-12, -12, 32, 32});
  const LightPicture part = drawn(t, {3, 5, 14, 12});
  for (int y = 5; y < 12; ++y)
    for (int x = 3; x < 14; ++x)
      RC_ASSERT(std::abs(whole.row(y)[x + 12][3] - part.row(y)[x - 3][3]) < 1e-4F);
}

TEST(AreaRaster, PiecesThatMeetLeaveNoSeam) {
  const Vector2d a(2.3, 1.7), b(11.1, 2.9), c(9.4, 12.2), d(1.2, 9.9), middle(5.7, 6.1);
  AreaRaster raster;
  raster.begin({0, 0, 14, 14});
  for (const Triangle& piece : {Triangle{a, b, middle}, Triangle{b, c, middle},
                                Triangle{c, d, middle}, Triangle{d, a, middle}})
    raster.add(piece, white);
  LightPicture picture(raster.box());
  raster.draw_behind(picture);
  for (int y = 4; y < 9; ++y)
    for (int x = 4; x < 8; ++x) EXPECT_NEAR(picture.row(y)[x][3], 1, 1e-5) << x << " " << y;
}

}  // namespace
}  // namespace heft
