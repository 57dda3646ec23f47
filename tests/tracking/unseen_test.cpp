// The diagnosis of a picture in which the board was not found.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tracking/Scenes.h"
#include "tracking/Tracker.h"

namespace heft {
namespace {

using ::testing::HasSubstr;

Image board_picture() {
  const Apparatus apparatus = default_apparatus(640);
  SyntheticCamera camera({apparatus.camera, apparatus.board, {}}, {}, 1);
  return camera.picture([](double) { return std::nullopt; }, 0, 0);
}

Image mirrored(Image image) {
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width / 2; ++x)
      for (int c = 0; c < image.channels; ++c) {
        const auto at = [&](int column) {
          return static_cast<std::size_t>((y * image.width + column) * image.channels + c);
        };
        std::swap(image.pixels[at(x)], image.pixels[at(image.width - 1 - x)]);
      }
  return image;
}

TEST(WhyUnseen, NamesWhatThePictureShowsInstead) {
  const MarkerBody board = default_apparatus(640).board;
  const Image picture = board_picture();
  EXPECT_THAT(why_unseen(picture, board, "board"), HasSubstr("of the board's 24 tags can be read"));
  EXPECT_THAT(why_unseen(mirrored(picture), board, "board"), HasSubstr("is mirrored"));
  MarkerBody other = board;
  for (Tag& tag : other.tags) tag.id += 100;
  EXPECT_THAT(why_unseen(picture, other, "board"), HasSubstr("other tags of tag36h11 (0, 1, 2"));
  Image gray(640, 480, 1);
  EXPECT_THAT(why_unseen(gray, board, "board"), HasSubstr("is dark"));
  std::ranges::fill(gray.pixels, 255);
  EXPECT_THAT(why_unseen(gray, board, "board"), HasSubstr("is overexposed"));
  std::ranges::fill(gray.pixels, 128);
  EXPECT_THAT(why_unseen(gray, board, "board"), HasSubstr("shows none of the board's tags"));
  // A message about the effector must not be about the board.
  const MarkerBody effector = default_apparatus(640).effector;
  EXPECT_THAT(why_unseen(picture, effector, "effector", board),
              HasSubstr("shows none of the effector's tags"));
}

}  // namespace
}  // namespace heft
