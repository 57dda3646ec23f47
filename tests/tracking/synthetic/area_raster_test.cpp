#include <gtest/gtest.h>

#include <array>

#include "tracking/synthetic/AreaRaster.h"

namespace heft {
namespace {

using Eigen::Vector2d;
using Triangle = std::array<Vector2d, 3>;

const Light white(1, 1, 1, 1);

// Coverage of pixels by triangles is tested in base/scan_test.cpp.
TEST(AreaRaster, GivesAPixelTheLightOfWhatCoversIt) {
  const Light color(0.5F, 0.25F, 0.125F, 1);
  AreaRaster raster;
  raster.begin({2, 3, 9, 8});
  // From the middle of pixel 4 to the right edge of pixel 5, down half of row 6.
  raster.add(std::array<Vector2d, 4>{Vector2d(4, 4.5), {5.5, 4.5}, {5.5, 6}, {4, 6}}, color);
  LightPicture picture({0, 0, 12, 12});
  picture.row(5)[5] = Light(1, 1, 1, 1);  // in front of it
  raster.draw_behind(picture);
  const auto at = [&](int x, int y) { return picture.row(y)[x]; };
  EXPECT_TRUE(at(5, 5).isApprox(Light(1, 1, 1, 1)));
  EXPECT_TRUE(at(4, 5).isApprox(0.5F * color));
  EXPECT_TRUE(at(5, 6).isApprox(0.5F * color));
  EXPECT_TRUE(at(4, 6).isApprox(0.25F * color));
  for (const auto& [x, y] : {std::pair{3, 5}, {6, 5}, {5, 4}, {5, 7}, {0, 5}, {11, 6}})
    EXPECT_TRUE(at(x, y).isZero()) << x << " " << y;
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
