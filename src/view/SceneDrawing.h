// Draws what the participant sees: the camera picture, and over it cubes on the board with a soft
// contact shadow and the effector's clone, with correct depth between clone, cubes and table. One
// software rasterizer for every view, so what is recorded is what was seen.
#pragma once

#include <memory>
#include <optional>

#include "view/ArView.h"

namespace heft {

class SceneDrawing {
 public:
  explicit SceneDrawing(const ViewSetup& setup);
  ~SceneDrawing();
  SceneDrawing(SceneDrawing&&) noexcept;
  SceneDrawing& operator=(SceneDrawing&&) noexcept;

  /// The frame as shown: blue, green, red, of the camera's size (640 x 480 without a camera).
  /// Valid until the next call.
  const Image& draw(const ViewPicture& shown);

  /// The slot (from 1) of the cube drawn at a pixel of the last frame; none: no cube.
  std::optional<int> slot_at(double x_px, double y_px) const;

  /// The pixel above the middle of a cube's top in the last frame, where its label goes; none:
  /// not in the frame.
  std::optional<Eigen::Vector2d> label_place(int slot) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace heft
