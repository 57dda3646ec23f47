// What one screen consists of, as plain data: text, the scene's place, and controls with their
// places and effects. The screens fill a page, the painter draws it, taps are looked up in it.
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

/// Marks a cube as the one that the next label is for; the session need not know.
struct SelectCube {
  int slot = 1;
};

/// Turns to another part of a long text or another question of a form.
struct TurnPart {
  int by = 1;
};

/// Sets an entry to where it is tapped, 0...100.
struct Slide {
  std::string key;
  bool from_the_right = false;
  bool typed = false;  ///< kept as a number that is being typed is
};

/// A number that is being typed, so far: an answer only when the question is left.
struct Typed {
  std::string key, value;
};

/// What a tap does: something that the session must know, or something between view and person.
using Effect = std::variant<Touch, SelectCube, TurnPart, Slide, Typed>;

enum class Look { plain, primary };

/// How far from its left end a slider is set; none: not yet.
struct SliderValue {
  std::optional<float> fraction;
};

struct Control {
  std::string name;  ///< stable, for tests and scripts: "validate", "cube_1", "label_lightest"
  Rect area;
  std::string text;
  std::string note;  ///< a second line: which cube has this label
  Effect effect;
  char key = 0;  ///< the keyboard's equivalent (see WindowView.h); 0: none
  Look look = Look::plain;
  bool enabled = true;
  bool chosen = false;                    ///< drawn as switched on
  std::optional<SliderValue> slide = {};  ///< drawn as a slider
  std::optional<Touch> entered = {};      ///< what was typed, which the session must know first
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
  float scene_opacity = 1;    ///< less while it fades
  std::string notice;         ///< one sentence over the scene's lower edge
  std::string hint;           ///< over its upper edge, away from the effector that it is about
  std::vector<CubeMark> marks;
};

/// The rule: touch targets are at least 0.14 of the window's height (of 0.6 of its width, if that
/// is less). On a 7" touch screen of 1024 x 600 that is 84 px or 12.5 mm, at 1280 x 800 107 px or
/// 12.7 mm, on one of 1920 x 1080 151 px or 12.2 mm; on larger screens more.
struct Measures {
  float width, height;       ///< of the window, in pixels
  float target;              ///< least width and height of what can be tapped
  float gap, margin;         ///< between controls; around them
  float small, body, title;  ///< text
  float text_size;           ///< times as large as usual

  /// @param size of text, times as large as usual; targets and their places stay
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

  /// The least that a text of that size may become where there is little room: half of what is
  /// usual, however large texts are asked for.
  float least_px(float size_px) const { return 0.5f * size_px / std::max(1.0f, text_size); }
};

class Taps {
 public:
  /// A finger's number, or that of the mouse.
  using Pointer = std::int64_t;
  static constexpr Pointer mouse = -1;

  void down(Pointer pointer, const std::string& target) { pressed_[pointer] = target; }

  /// @param target what the pointer left the screen over; none: nothing
  /// @return whether that was a tap on the target
  bool up(Pointer pointer, const std::optional<std::string>& target) {
    const auto press = pressed_.extract(pointer);
    return target && !press.empty() && press.mapped() == *target;
  }

  /// The page turned: no tap may begin on one page and end on the next.
  void forget() { pressed_.clear(); }

  bool holds(std::string_view target) const {
    return std::ranges::any_of(pressed_, [&](const auto& press) { return press.second == target; });
  }

 private:
  std::map<Pointer, std::string> pressed_;
};

}  // namespace heft
