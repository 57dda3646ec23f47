// Triangles: covered samples, depth, and clearing between frames.
#include "view/scene/Rasterizer.h"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <limits>

#include "base/Error.h"
#include "base/Random.h"

namespace heft {
namespace {

using Eigen::Vector2d;

constexpr int frame_w_px = 40, frame_h_px = 30;
constexpr Surface red{{0, 0, 200}, 1, 1}, green{{0, 200, 0}, 1, 2};
constexpr Surface glass{{255, 0, 0}, 0.5, 0};

Image gray_frame() {
  Image frame(frame_w_px, frame_h_px, 3);
  std::ranges::fill(frame.pixels, std::uint8_t{100});
  return frame;
}

std::array<int, 3> pixel_of(const Image& frame, int x, int y) {
  const auto at = static_cast<std::size_t>(3 * (y * frame.width + x));
  return {frame.pixels[at], frame.pixels[at + 1], frame.pixels[at + 2]};
}

// A rectangle as two triangles.
void fill_rectangle(Rasterizer& rasterizer, Vector2d from, Vector2d to, double nearness,
                    std::uint8_t surface) {
  const RasterCorner a{from, nearness}, b{{to.x(), from.y()}, nearness}, c{to, nearness},
      d{{from.x(), to.y()}, nearness};
  rasterizer.fill({a, b, c}, surface);
  rasterizer.fill({a, c, d}, surface);
}

// Pixel centers are integers, so that pixel 10 extends from 9.5 to 10.5.
TEST(Rasterizer, PixelIsPaintedByCoveredShare) {
  Rasterizer rasterizer(frame_w_px, frame_h_px);
  Image frame = gray_frame();
  fill_rectangle(rasterizer, {9.5, 9.5}, {12.0, 11.5}, 1, rasterizer.add_surface(red));
  rasterizer.paint(frame);
  const std::array gray{100, 100, 100}, full{0, 0, 200}, half{50, 50, 150};
  EXPECT_EQ(pixel_of(frame, 9, 10), gray);
  EXPECT_EQ(pixel_of(frame, 10, 9), gray);
  EXPECT_EQ(pixel_of(frame, 10, 10), full);
  EXPECT_EQ(pixel_of(frame, 11, 11), full);
  EXPECT_EQ(pixel_of(frame, 12, 10), half);
  EXPECT_EQ(pixel_of(frame, 13, 10), gray);
  EXPECT_EQ(pixel_of(frame, 10, 12), gray);
}

TEST(Rasterizer, NearerSurfaceIsVisibleInAnyOrder) {
  for (bool red_first : {true, false}) {
    Rasterizer rasterizer(frame_w_px, frame_h_px);
    Image frame = gray_frame();
    const auto near = rasterizer.add_surface(red), far = rasterizer.add_surface(green);
    if (red_first) fill_rectangle(rasterizer, {5, 5}, {20, 20}, 2.0, near);
    fill_rectangle(rasterizer, {10, 10}, {30, 25}, 1.9, far);
    if (!red_first) fill_rectangle(rasterizer, {5, 5}, {20, 20}, 2.0, near);
    rasterizer.paint(frame);
    EXPECT_EQ(pixel_of(frame, 15, 15), (std::array{0, 0, 200}));
    EXPECT_EQ(pixel_of(frame, 25, 22), (std::array{0, 200, 0}));
  }
}

TEST(Rasterizer, DepthResolvesAHundredthOfAMillimeter) {
  Rasterizer rasterizer(frame_w_px, frame_h_px);
  Image frame = gray_frame();
  fill_rectangle(rasterizer, {5, 5}, {20, 20}, 1 / 0.60001, rasterizer.add_surface(green));
  fill_rectangle(rasterizer, {5, 5}, {20, 20}, 1 / 0.60000, rasterizer.add_surface(red));
  fill_rectangle(rasterizer, {5, 5}, {20, 20}, 1 / 0.60002, rasterizer.add_surface(green));
  rasterizer.paint(frame);
  EXPECT_EQ(pixel_of(frame, 10, 10), (std::array{0, 0, 200}));
}

TEST(Rasterizer, TranslucentSurfaceMixesWithSurfacesBehindIt) {
  for (double depth : {0.5, 2.0}) {
    Rasterizer rasterizer(frame_w_px, frame_h_px);
    Image frame = gray_frame();
    fill_rectangle(rasterizer, {5, 5}, {30, 20}, depth, rasterizer.add_surface(glass));
    fill_rectangle(rasterizer, {15, 5}, {30, 20}, 1, rasterizer.add_surface(red));
    rasterizer.paint(frame);
    EXPECT_EQ(pixel_of(frame, 10, 10), (std::array{178, 50, 50}));
    const std::array in_front{128, 0, 100}, behind{0, 0, 200};
    EXPECT_EQ(pixel_of(frame, 20, 10), depth > 1 ? in_front : behind);
  }
}

// Shades multiply, so that a sample drawn twice would be darker and a missing one lighter.
RC_GTEST_PROP(Rasterizer, TrianglesAroundAPointCoverASquareExactlyOnce, ()) {
  RandomStream draws(*rc::gen::arbitrary<std::uint64_t>(), "triangles");
  const auto between = [&](double low, double high) {
    return low + (high - low) * draws.uniform();
  };
  const std::array<Vector2d, 4> square{Vector2d(4.5, 4.5), {24.5, 4.5}, {24.5, 24.5}, {4.5, 24.5}};
  const Vector2d middle(between(4.6, 24.4), between(4.6, 24.4));
  Rasterizer rasterizer(frame_w_px, frame_h_px);
  for (std::size_t i = 0; i < 4; ++i)
    rasterizer.shade({RasterCorner{middle, 0.5}, {square[i], 0.5}, {square[(i + 1) % 4], 0.5}});
  Image frame = gray_frame();
  rasterizer.paint(frame);
  for (int y = 0; y < frame_h_px; ++y) {
    for (int x = 0; x < frame_w_px; ++x) {
      const bool inside = x >= 5 && x <= 24 && y >= 5 && y <= 24;
      RC_ASSERT(pixel_of(frame, x, y)[0] == (inside ? 50 : 100));
    }
  }
}

RasterTriangle random_triangle(RandomStream& draws) {
  RasterTriangle triangle;
  for (RasterCorner& corner : triangle)
    corner = {{frame_w_px * (2 * draws.uniform() - 0.5), frame_h_px * (2 * draws.uniform() - 0.5)},
              0.5 + draws.uniform()};
  return triangle;
}

void draw_some(Rasterizer& rasterizer, RandomStream draws) {
  const std::array surfaces{rasterizer.add_surface(red), rasterizer.add_surface(green),
                            rasterizer.add_surface(glass)};
  for (std::size_t i = 0; i < 9; ++i) rasterizer.fill(random_triangle(draws), surfaces[i % 3]);
  RasterTriangle shade = random_triangle(draws);
  for (RasterCorner& corner : shade) corner.value = draws.uniform();
  rasterizer.shade(shade);
}

RC_GTEST_PROP(Rasterizer, ClearedRasterizerEqualsANewOne, (std::uint64_t seed)) {
  Rasterizer used(frame_w_px, frame_h_px), fresh(frame_w_px, frame_h_px);
  draw_some(used, RandomStream(seed, "before"));
  used.clear();
  Image cleared = gray_frame();
  used.paint(cleared);
  RC_ASSERT(cleared.pixels == gray_frame().pixels);
  draw_some(used, RandomStream(seed, "after"));
  draw_some(fresh, RandomStream(seed, "after"));
  Image one = gray_frame(), other = gray_frame();
  used.paint(one);
  fresh.paint(other);
  RC_ASSERT(one.pixels == other.pixels);
}

TEST(Rasterizer, NearestObjectWithinReachIsFound) {
  Rasterizer rasterizer(frame_w_px, frame_h_px);
  fill_rectangle(rasterizer, {5, 5}, {10, 10}, 1, rasterizer.add_surface(red));
  fill_rectangle(rasterizer, {20, 5}, {25, 10}, 1, rasterizer.add_surface(green));
  EXPECT_EQ(rasterizer.find_object({7, 7}, 1), 1);
  EXPECT_EQ(rasterizer.find_object({14, 7}, 8), 1);
  EXPECT_EQ(rasterizer.find_object({16, 7}, 8), 2);
  EXPECT_EQ(rasterizer.find_object({7, 20}, 8), std::nullopt);
  EXPECT_EQ(rasterizer.find_object({-1e12, 1e300}, 8), std::nullopt);
}

TEST(Rasterizer, FarAndNotANumberCornersAreHandled) {
  Rasterizer rasterizer(frame_w_px, frame_h_px);
  const auto surface = rasterizer.add_surface(red);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  rasterizer.fill({RasterCorner{{nan, 3}, 1}, {{30, 3}, 1}, {{3, 20}, 1}}, surface);
  rasterizer.fill({RasterCorner{{-1e30, 3}, 1}, {{-1e30, 1e30}, 1}, {{3, -1e30}, 1}}, surface);
  Image frame = gray_frame();
  rasterizer.paint(frame);
  rasterizer.fill({RasterCorner{{-1e6, -1e6}, 1}, {{1e6, -1e6}, 1}, {{0, 1e6}, 1}}, surface);
  rasterizer.paint(frame);
  EXPECT_EQ(pixel_of(frame, 0, 0), (std::array{0, 0, 200}));
  EXPECT_EQ(pixel_of(frame, frame_w_px - 1, frame_h_px - 1), (std::array{0, 0, 200}));
}

TEST(Rasterizer, MoreThan255SurfacesAreRefused) {
  Rasterizer rasterizer(frame_w_px, frame_h_px);
  for (int i = 0; i < 255; ++i) rasterizer.add_surface(red);
  EXPECT_THROW(rasterizer.add_surface(red), Error);
  rasterizer.clear();
  EXPECT_EQ(rasterizer.add_surface(red), 1);
}

}  // namespace
}  // namespace heft
