// A tag of which only some edges are seen.
#include <gtest/gtest.h>

#include <cmath>

#include "tracking/TagEdges.h"
#include "tracking/TagFamily.h"

namespace heft {
namespace {

constexpr double cell_px = 9;
constexpr double blur_px = 0.7;
constexpr int margin_px = 40;

double covered_from(double edge_px, double at_px) {
  return std::erfc((edge_px - at_px) / (std::sqrt(2.0) * blur_px)) / 2;
}

// A dark square on white, and a bar as dark over its upper and its lower edge.
TEST(MeasuredTag, EdgesThatWereNotFoundLookAsTheOthersDo) {
  const TagPattern pattern = tag_pattern("tag36h11", 0);
  const double side_px = cell_px * pattern.border_cells, low = margin_px, high = low + side_px;
  Image image(2 * margin_px + static_cast<int>(side_px), 2 * margin_px + static_cast<int>(side_px),
              1);
  const auto inside = [&](double at) { return covered_from(low, at) - covered_from(high, at); };
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const bool barred = std::min(std::abs(y - low), std::abs(y - high)) < cell_px;
      const double dark = barred ? 1 : inside(x) * inside(y);
      image.pixels[static_cast<std::size_t>(y * image.width + x)] =
          static_cast<std::uint8_t>(std::lround(
              stored_of_light(pattern.bright_outside ? 0.6 - 0.5 * dark : 0.1 + 0.5 * dark).value));
    }
  Intrinsics camera;
  camera.cx_px = camera.cy_px = margin_px + side_px / 2;
  const MeasuredTag tag = measure_tag(
      image, camera, pattern, {Eigen::Vector2d(low, low), {high, low}, {high, high}, {low, high}},
      {.blur_px = blur_px});
  int n_found = 0;
  for (const FittedEdge& edge : tag.edges) n_found += edge.quality > 0 ? 1 : 0;
  EXPECT_EQ(n_found, 2);
  for (const FittedEdge& edge : tag.edges) {
    EXPECT_NEAR(edge.blur_px, blur_px, 0.15);
    EXPECT_NEAR(edge.dark, stored_of_light(0.1).value, 6);
    EXPECT_NEAR(edge.bright, stored_of_light(0.6).value, 6);
  }
}

}  // namespace
}  // namespace heft
