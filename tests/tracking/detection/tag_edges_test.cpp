// A tag of which only some edges are seen.
#include <gtest/gtest.h>

#include <cmath>

#include "tracking/detection/TagEdges.h"
#include "tracking/detection/TagFamily.h"

namespace heft {
namespace {

constexpr double side_px_of_cell = 9;
constexpr double blur_px = 0.7;
constexpr int margin_px = 40;

double covered_from(double edge_px, double at_px) {
  return std::erfc((edge_px - at_px) / (std::sqrt(2.0) * blur_px)) / 2;
}

// A dark square on white, with equally dark bars over its upper and its lower edge.
TEST(MeasuredTag, EdgesThatWereNotFoundLookAsTheOthersDo) {
  const TagPattern pattern = tag_pattern("tag36h11", 0);
  const double side_px = side_px_of_cell * pattern.border_cells, low = margin_px,
               high = low + side_px;
  Image image(2 * margin_px + static_cast<int>(side_px), 2 * margin_px + static_cast<int>(side_px),
              1);
  const auto inside = [&](double at) { return covered_from(low, at) - covered_from(high, at); };
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const bool barred = std::min(std::abs(y - low), std::abs(y - high)) < side_px_of_cell;
      const double dark = barred ? 1 : inside(x) * inside(y);
      image.pixels[static_cast<std::size_t>(y * image.width + x)] =
          static_cast<std::uint8_t>(std::lround(
              stored_of_light(pattern.bright_outside ? 0.6 - 0.5 * dark : 0.1 + 0.5 * dark).value));
    }
  Intrinsics camera;
  camera.cx_px = camera.cy_px = margin_px + side_px / 2;
  const std::array<Eigen::Vector2d, 4> corners_px{
      Eigen::Vector2d(low, low), {high, low}, {high, high}, {low, high}};
  const MeasuredTag tag = measure_tag(image, camera, pattern, corners_px, {.blur_px = blur_px});
  int n_found = 0;
  for (const FittedEdge& edge : tag.edges) n_found += edge.quality > 0 ? 1 : 0;
  EXPECT_EQ(n_found, 2);
  for (const FittedEdge& edge : tag.edges) {
    EXPECT_NEAR(edge.blur_px, blur_px, 0.15);
    EXPECT_NEAR(edge.dark, stored_of_light(0.1).value, 6);
    EXPECT_NEAR(edge.bright, stored_of_light(0.6).value, 6);
  }
  EXPECT_GT(tag.quality, 0.4);
  const EdgeMeasuring whole{.blur_px = blur_px, .whole = true};
  EXPECT_EQ(measure_tag(image, camera, pattern, corners_px, whole).quality, 0);
}

// A dark square, blurred more from left to right than up and down. With the known blur, one fit for
// each edge gives the same corners; with another blur, nearly the same.
TEST(MeasuredTag, IsMeasuredAgainAsBlurredAsItWas) {
  const TagPattern pattern = tag_pattern("tag36h11", 0);
  const double side_px = side_px_of_cell * pattern.border_cells, low = margin_px,
               high = low + side_px;
  Image image(2 * margin_px + static_cast<int>(side_px), 2 * margin_px + static_cast<int>(side_px),
              1);
  const auto inside = [&](double at, double wider) {
    const auto from = [&](double edge) { return covered_from(edge / wider, at / wider); };
    return from(low) - from(high);
  };
  constexpr double wider = 1.5;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      image.pixels[static_cast<std::size_t>(y * image.width + x)] = static_cast<std::uint8_t>(
          std::lround(stored_of_light(0.6 - 0.5 * inside(x, wider) * inside(y, 1)).value));
  Intrinsics camera;
  camera.cx_px = camera.cy_px = margin_px + side_px / 2;
  const double off_px = 0.3;
  const std::array<Eigen::Vector2d, 4> expected{Eigen::Vector2d(low + off_px, low),
                                                {high + off_px, low},
                                                {high + off_px, high},
                                                {low + off_px, high}};
  const EdgeMeasuring how{.blur_px = blur_px};
  const MeasuredTag first = measure_tag(image, camera, pattern, expected, how);
  const double upright_px = (first.edges[1].blur_px + first.edges[3].blur_px) / 2;
  const double level_px = (first.edges[0].blur_px + first.edges[2].blur_px) / 2;
  EXPECT_NEAR(upright_px, wider * blur_px, 0.1);
  EXPECT_NEAR(level_px, blur_px, 0.1);
  const auto off = [&](const std::array<double, 2>& known_px) {
    const MeasuredTag again = measure_tag_again(image, camera, pattern, expected, known_px, how);
    double worst = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_GT(again.edges[i].quality, 0.9);
      worst = std::max(worst, (again.corners_px[i] - first.corners_px[i]).norm());
    }
    return worst;
  };
  EXPECT_LT(off({upright_px, level_px}), 0.005);
  EXPECT_LT(off({level_px, level_px}), 0.05);
}

}  // namespace
}  // namespace heft
