// The content of one screen as plain data: text, the scene's place, and controls with their places
// and effects. Screens fill a page, the painter draws it, and taps are looked up in it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "experiment/ScreenState.h"

namespace heft {

/// In pixels of the window, from its top-left corner.
struct Rect {
  float x = 0, y = 0, width = 0, height = 0;

  float right() const { return x + width; }
  float bottom() const { return y + height; }
  bool contains(float point_x, float point_y) const {
    return point_x >= x && point_x < right() && point_y >= y && point_y < bottom();
  }
  bool overlaps(const Rect& other) const {
    return x < other.right() && other.x < right() && y < other.bottom() && other.y < bottom();
  }
};

/// Selects the cube for the next label; not reported to the session.
struct SelectCube {
  int slot = 1;
};

/// Turns to another part of a long text or another question of a form.
struct TurnPart {
  int by = 1;
};

/// Sets an entry by the tapped position, 0...100.
struct Slide {
  std::string key;
  bool from_the_right = false;
  bool typed = false;  ///< a number that is still being typed
};

/// A number being typed; it becomes an answer when the question is left.
struct Typed {
  std::string key, value;
};

/// The effect of a tap: reported to the session, or within the page.
using Effect = std::variant<Touch, SelectCube, TurnPart, Slide, Typed>;

enum class Look { plain, primary };

/// Position of a slider from its left end; none: not set.
struct SliderValue {
  std::optional<float> fraction;
};

struct Control {
  std::string name;  ///< stable, for tests and scripts: "validate", "cube_1", "label_lightest"
  Rect area;
  std::string text;
  std::string note;  ///< a second line: the cube that has this label
  Effect effect;
  char key = 0;  ///< the equivalent key (see WindowView.h); 0: none
  Look look = Look::plain;
  bool enabled = true;
  bool chosen = false;                    ///< drawn as switched on
  std::optional<SliderValue> slide = {};  ///< drawn as a slider
  std::optional<Touch> entered = {};  ///< a typed entry, reported to the session before the effect
};

enum class Tone { strong, soft };

struct TextLine {
  std::string text;
  float x = 0, y = 0;  ///< top-left corner
  float size_px = 0;
  Tone tone = Tone::strong;
};

/// A text over a cube in the scene; an empty one with `selected` only marks the cube.
struct CubeMark {
  int slot = 1;
  std::string text;
  bool selected = false;
};

struct Page {
  std::vector<TextLine> lines;
  std::vector<Control> controls;
  std::optional<Rect> scene;  ///< the scene is fitted into it; none: no scene
  float scene_opacity = 1;    ///< lower while it fades
  std::string notice;         ///< one sentence over the scene's lower edge
  std::string hint;  ///< over the scene's upper edge, away from the effector that it refers to
  std::vector<CubeMark> marks;
};

/// Sizes of a window. Touch targets are at least 0.14 of the window's height (or of 0.6 of its
/// width, if smaller): 84 px or 12.5 mm on a 7" touch screen of 1024 x 600, 107 px or 12.7 mm at
/// 1280 x 800, 151 px or 12.2 mm at 1920 x 1080; more on larger screens.
struct Measures {
  float width, height;       ///< of the window, in pixels
  float target;              ///< least width and height of a touch target
  float gap, margin;         ///< between controls; around them
  float small, body, title;  ///< sizes of text
  float text_size;           ///< relative to the usual size

  /// @param size of texts, relative to the usual size; targets do not change
  Measures(float width_px, float height_px, float size = 1)
      : width(width_px), height(height_px), text_size(size) {
    const float unit = std::min(height_px, 0.6f * width_px);
    target = 0.14f * unit;
    gap = 0.016f * unit;
    margin = 0.025f * unit;
    small = 0.031f * unit * text_size;
    body = 0.042f * unit * text_size;
    title = 0.065f * unit * text_size;
  }

  /// The smallest size for a text where space is short: half of the usual, whatever size is
  /// requested.
  float least_px(float size_px) const { return 0.5f * size_px / std::max(1.0f, text_size); }
};

class Taps {
 public:
  /// A finger's number, or the mouse's.
  using Pointer = std::int64_t;
  static constexpr Pointer mouse = -1;

  void down(Pointer pointer, const std::string& target) { pressed_[pointer] = target; }

  /// @param target the control where the pointer was lifted; none: outside of all
  /// @return whether that was a tap on the target
  bool up(Pointer pointer, const std::optional<std::string>& target) {
    const auto press = pressed_.extract(pointer);
    return target && !press.empty() && press.mapped() == *target;
  }

  /// The page has turned: a tap must not begin on one page and end on the next.
  void forget() { pressed_.clear(); }

  bool holds(std::string_view target) const {
    return std::ranges::any_of(pressed_, [&](const auto& press) { return press.second == target; });
  }

 private:
  std::map<Pointer, std::string> pressed_;
};

}  // namespace heft
