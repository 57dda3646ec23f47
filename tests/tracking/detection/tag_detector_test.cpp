// The detector's conventions, on tags drawn cell by cell from the families' own patterns.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/Error.h"
#include "base/Random.h"
#include "tracking/detection/TagDetector.h"
#include "tracking/detection/TagFamily.h"

namespace heft {
namespace {

constexpr int cell_px = 8, left = 60, top = 40;

Image drawn(const std::string& family, int id, std::uint8_t black = 25, std::uint8_t white = 230) {
  const TagPattern pattern = tag_pattern(family, id);
  Image image(240, 200, 1);
  std::ranges::fill(image.pixels, static_cast<std::uint8_t>((black + white) / 2));
  const int outer_white = 8;  // some families have none of their own around
  for (int y = -outer_white; y < pattern.n_cells * cell_px + outer_white; ++y)
    for (int x = -outer_white; x < pattern.n_cells * cell_px + outer_white; ++x) {
      const int column = x / cell_px, row = y / cell_px;
      const bool inside = x >= 0 && y >= 0 && column < pattern.n_cells && row < pattern.n_cells;
      image.pixels[static_cast<std::size_t>((top + y) * image.width + left + x)] =
          !inside || pattern.is_white(column, row) ? white : black;
    }
  return image;
}

TEST(TagDetector, CornersAreInOurOrderAndPixelConvention) {
  for (const std::string family : {"tag36h11", "tag25h9", "tag16h5", "tagStandard41h12"}) {
    const TagPattern pattern = tag_pattern(family, 3);
    const Image image = drawn(family, 3);
    const auto tags = TagDetector(family, 1).detect(image, whole(image));
    ASSERT_EQ(tags.size(), 1U) << family;
    EXPECT_EQ(tags[0].id, 3);
    // Between pixels: the first pixel of the border is half a pixel further in.
    const double near = pattern.margin_cells() * cell_px - 0.5;
    const double far = near + pattern.border_cells * cell_px;
    const Eigen::Vector2d origin(left, top);
    const std::array<Eigen::Vector2d, 4> expected{
        origin + Eigen::Vector2d(near, near), origin + Eigen::Vector2d(far, near),
        origin + Eigen::Vector2d(far, far), origin + Eigen::Vector2d(near, far)};
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_LT((tags[0].corners_px[i] - expected[i]).norm(), 0.5) << family << ' ' << i;
  }
}

TEST(TagDetector, ARegionGivesThePicturesCoordinates) {
  const Image image = drawn("tag36h11", 7);
  TagDetector detector("tag36h11", 1);
  const auto all = detector.detect(image, whole(image));
  const auto part = detector.detect(image, {41, 22, 150, 1000});
  ASSERT_EQ(all.size(), 1U);
  ASSERT_EQ(part.size(), 1U);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_LT((all[0].corners_px[i] - part[0].corners_px[i]).norm(), 0.2);
  EXPECT_TRUE(detector.detect(image, {0, 0, 60, 200}).empty());
  EXPECT_TRUE(detector.detect(image, {500, 500, 60, 200}).empty());
  EXPECT_TRUE(detector.detect(image, {-500, -500, 60, 200}).empty());
}

TEST(TagDetector, FindsAPalePrint) {
  const Image image = drawn("tag36h11", 7, 110, 128);
  EXPECT_EQ(TagDetector("tag36h11", 1).detect(image, whole(image)).size(), 1U);
}

// A dim tag in the corner of a bright, noisy picture.
Image shaded_scene() {
  Image image(640, 480, 1);
  RandomStream random(1, "noise");
  for (auto& pixel : image.pixels)
    pixel = static_cast<std::uint8_t>(
        std::clamp(std::lround(120 + 60 * random.uniform() + 3 * random.normal()), 0L, 255L));
  const Image tag = drawn("tag36h11", 7, 30, 50);
  for (int y = 0; y < tag.height; ++y)
    std::copy_n(&tag.pixels[static_cast<std::size_t>(y) * tag.row_bytes()], tag.width,
                &image.pixels[static_cast<std::size_t>(y) * image.row_bytes()]);
  return image;
}

TEST(TagDetector, EverywhereIsInDeepShadowToo) {
  const Image image = shaded_scene();
  TagDetector detector("tag36h11", 1);
  EXPECT_TRUE(detector.detect(image, whole(image)).empty());  // what the quick search leaves out
  EXPECT_EQ(detector.detect(image, whole(image), EdgeSearch::everywhere).size(), 1U);
}

TEST(TagDetector, FindsAClearTagInNoiseEitherWay) {
  Image image = drawn("tag36h11", 7);
  RandomStream random(1, "noise");
  for (auto& pixel : image.pixels)
    pixel =
        static_cast<std::uint8_t>(std::clamp(std::lround(pixel + 10 * random.normal()), 0L, 255L));
  TagDetector detector("tag36h11", 1);
  for (const EdgeSearch search : {EdgeSearch::above_noise, EdgeSearch::everywhere})
    EXPECT_EQ(detector.detect(image, whole(image), search).size(), 1U);
}

TEST(TagDetector, OneDetectorContinuesWhenAnotherOfItsFamilyEnds) {
  const Image image = drawn("tag36h11", 7);
  TagDetector detector("tag36h11", 1);
  { TagDetector other("tag36h11", 1); }
  EXPECT_EQ(detector.detect(image, whole(image)).size(), 1U);
}

TEST(TagDetector, AnUnknownFamilyIsRefused) {
  EXPECT_THROW(TagDetector("tag37h11", 1), Error);
}

}  // namespace
}  // namespace heft
