// The look of the participant's screens: paints a page. Calm and of high contrast, dark around the
// scene, one accent color for what leads on.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "view/window/Measures.h"
#include "view/window/Page.h"
#include "view/window/Typeface.h"

struct ImDrawList;

namespace heft {

/// The scene's frame on the screen.
struct PaintedScene {
  unsigned texture = 0;
  Rect area;
};

/// A mark at its place on the screen: the tip of a small flag above a cube.
struct PlacedMark {
  CubeMark mark;
  float x = 0, y = 0;
};

/// What a page is painted with besides itself.
struct Paint {
  const Typeface& typeface;
  const Measures& measures;
  std::optional<PaintedScene> scene;
  std::vector<PlacedMark> marks;
  std::function<bool(const std::string& control)> is_pressed;
};

/// A control's words and the note below them, made to fit their places on it.
struct ControlWords {
  FittedText text, note;
  Rect text_area, note_area;  ///< the note's is empty where there is none
};

ControlWords words_on(const Control& control, const Typeface& typeface, const Measures& measures);

void paint_page(ImDrawList& list, const Page& page, const Paint& paint);

/// The largest place inside `room`, centered, for a frame of that size.
Rect fitted_scene(const Rect& room, int width_px, int height_px);

}  // namespace heft
