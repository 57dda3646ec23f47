// The scene's frame at its place on the screen: takes places between pixels of the window and
// pixels of the frame, and says which cube a finger means.
#pragma once

#include <optional>
#include <vector>

#include "view/SceneDrawing.h"
#include "view/window/Page.h"
#include "view/window/Painter.h"

namespace heft {

class SceneOnScreen {
 public:
  explicit SceneOnScreen(const ViewSetup& setup) : drawing_(setup) {}

  /// As SceneDrawing::draw.
  const Image& draw(const ViewPicture& shown);

  /// Where the page has room for it; none: this page has none.
  void place(const std::optional<Rect>& room);
  /// Where it is; none: on no page, or nothing is drawn yet.
  const std::optional<Rect>& area() const { return area_; }

  /// The cube at a pixel of the window, or else the only one within reach of it.
  std::optional<int> slot_near(float x, float y, float reach_px) const;
  /// The marks of cubes that are in the frame.
  std::vector<PlacedMark> placed(const std::vector<CubeMark>& marks) const;

 private:
  std::optional<int> slot_at(float x, float y) const;
  float scale() const { return area_->width / static_cast<float>(width_px_); }

  SceneDrawing drawing_;
  int width_px_ = 0, height_px_ = 0;  ///< of the frame
  std::optional<Rect> area_;
};

}  // namespace heft
