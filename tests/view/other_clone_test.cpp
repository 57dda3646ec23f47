// The clone of a what-if simulation, drawn beside the logged one.
#include <gmock/gmock.h>

#include "view/Scenes.h"

namespace heft {
namespace {
using namespace heft::test;

// Pixels of a color that differ from the frame without drawings.
int count(const Image& image, bool (*leans)(const Bgr&)) {
  int n = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) n += leans(at(image, x, y));
  return n;
}

bool purple(const Bgr& p) {
  return p.red > p.green + 40 && p.blue > p.green + 15;
}
bool blue(const Bgr& p) {
  return p.blue > p.red + 80 && p.green > p.red + 20;
}

class OtherClone : public testing::Test {
 protected:
  OtherClone() {
    shown.frame.cubes.clear();
    shown.frame.clone = pointing_away(-0.05, -0.05);
  }
  const ViewSetup setup = setup_with(Intrinsics{});
  SceneDrawing drawing{setup};
  ViewFrame shown = three_cubes(setup);
};

TEST_F(OtherClone, BothClonesAreDrawnInTheirColors) {
  const Image alone = drawing.draw(shown);
  shown.other_clone = pointing_away(0.05, -0.05);
  const Image both = drawing.draw(shown);
  EXPECT_EQ(count(alone, purple), 0);
  EXPECT_GT(count(alone, blue), 2000);
  EXPECT_EQ(count(both, blue), count(alone, blue));
  EXPECT_GT(count(both, purple), count(both, blue) / 10) << "an outline";
}

TEST_F(OtherClone, AnOutlineAtTheSamePlaceHidesNoClone) {
  const int n_blue = count(drawing.draw(shown), blue);
  shown.other_clone = shown.frame.clone;
  const Image both = drawing.draw(shown);
  EXPECT_GT(count(both, blue), 0.7 * n_blue);
  EXPECT_GT(count(both, purple), 0.05 * n_blue);
}

TEST_F(OtherClone, FrameWithoutOtherCloneIsUnchanged) {
  const Image before = drawing.draw(shown);
  shown.other_clone = pointing_away(0.05, -0.05);
  drawing.draw(shown);
  shown.other_clone.reset();
  EXPECT_EQ(drawing.draw(shown).pixels, before.pixels);
}

}  // namespace
}  // namespace heft
