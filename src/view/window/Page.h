// What one screen consists of, as plain data: text, the scene's place, and controls with their
// places and effects. The screens fill a page, the painter draws it, taps are looked up in it.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "experiment/Touch.h"

namespace heft {

/// In pixels of the window, from its top-left corner.
struct Rect {
  float x = 0, y = 0, width = 0, height = 0;

  float right() const { return x + width; }
  float bottom() const { return y + height; }
  bool contains(float point_x, float point_y) const {
    return point_x >= x && point_x < right() && point_y >= y && point_y < bottom();
  }
};

/// Marks a cube as the one that the next label is for; the session need not know.
struct SelectCube {
  int slot = 1;
};

/// Turns to another part of a long text or another question of a form.
struct TurnPart {
  int by = 1;
};

/// What a tap does: something that the session must know, or something between view and person.
using Effect = std::variant<Touch, SelectCube, TurnPart>;

enum class Look { plain, primary };

struct Control {
  std::string name;  ///< stable, for tests and scripts: "validate", "cube_1", "label_lightest"
  Rect area;
  std::string text;
  std::string note;  ///< a second line: which cube has this label
  Effect effect;
  char key = 0;  ///< the keyboard's equivalent (see WindowView.h); 0: none
  Look look = Look::plain;
  bool enabled = true;
  bool chosen = false;  ///< drawn as switched on
};

enum class Tone { strong, soft };

struct TextLine {
  std::string text;
  float x = 0, y = 0;  ///< top-left corner
  float size_px = 0;
  Tone tone = Tone::strong;
};

/// Something written over a cube in the scene; an empty text with `selected` marks it only.
struct CubeMark {
  int slot = 1;
  std::string text;
  bool selected = false;
};

struct Page {
  std::vector<TextLine> lines;
  std::vector<Control> controls;
  std::optional<Rect> scene;  ///< where the scene goes, as large as fits; none: no scene
  std::string notice;         ///< one sentence over the scene's lower edge
  std::vector<CubeMark> marks;
};

}  // namespace heft
