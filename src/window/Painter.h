// Paints the participant's screens: calm and of high contrast, dark around the scene, one accent
// color for the button that continues. Also places the scene's frame, converts between pixels of
// the window and of the frame, and finds the cube under a finger.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "view/scene/SceneDrawing.h"
#include "view/screens/TextFit.h"
#include "view/text/Typeface.h"

struct ImDrawList;

namespace heft {

/// Behind everything, of 255. GlWindow clears the frame to it, which software rendering does five
/// times as fast as it paints a rectangle.
inline constexpr std::array background_rgb{20, 23, 27};

/// The scene's frame on the screen.
struct PaintedScene {
  unsigned texture = 0;
  Rect area;
  Rect part{0, 0, 1, 1};  ///< displayed part of the frame, as fractions of it
  float opacity = 1;
};

/// A mark on the screen: the tip of a small flag above a cube.
struct PlacedMark {
  CubeMark mark;
  float x = 0, y = 0;
};

/// A line of text as a texture; the place of its ink is relative to the line's left end at its top.
struct WrittenTexture {
  unsigned texture = 0;  ///< white; its opacity is the ink
  int left = 0, top = 0, width = 0, height = 0;
  bool used = true;  ///< in this frame
};

/// Textures of an OpenGL context, which must be current whenever this is used or destroyed. They
/// are made when first drawn, and deleted after a frame without them.
class WrittenTextures {
 public:
  WrittenTextures() = default;
  ~WrittenTextures();
  WrittenTextures(const WrittenTextures&) = delete;
  WrittenTextures& operator=(const WrittenTextures&) = delete;

  const WrittenTexture& of(const WrittenLine& line, const Typeface& typeface);
  /// Deletes textures that the frame did not use.
  void end_frame();

 private:
  std::map<WrittenLine, WrittenTexture> textures_;
};

/// What a page is painted with.
struct Paint {
  const Typeface& typeface;
  const Measures& measures;
  WrittenTextures& textures;
  std::optional<PaintedScene> scene;
  std::vector<PlacedMark> marks;
  std::function<bool(const std::string& control)> is_pressed;
  /// Whether a touch of the control counts now; those that do not are drawn as if disabled.
  std::function<bool(const std::string& control)> takes_touches;
  std::optional<Patch> patch = {};
};

/// Paints the page on a frame of the background's color.
void paint_page(ImDrawList& list, const Page& page, const Paint& paint);

class SceneOnScreen {
 public:
  explicit SceneOnScreen(const ViewSetup& setup) : drawing_(setup), shown_m_(setup.shown_m) {}

  /// See SceneDrawing::draw.
  const Image& draw(const ViewFrame& shown);

  /// Sets the page's area for the scene; none: no scene.
  void place(const std::optional<Rect>& space);
  /// The scene's area; none: no scene, or nothing was drawn yet.
  const std::optional<Rect>& area() const { return area_; }
  /// The displayed part, as fractions of the frame.
  Rect part() const;

  /// The cube at a pixel of the window, else the only one within reach of it.
  std::optional<int> slot_near(float x, float y, float reach_px) const;
  /// The point at that height over the table that is seen at a pixel of the window, or at the
  /// nearest pixel of the scene.
  std::optional<Eigen::Vector3d> point_at_height(float x, float y, double height_m) const;
  /// Distance in pixels of the window between two points of the board frame; none: not both are
  /// visible.
  std::optional<double> distance_px(const Eigen::Vector3d& a_m, const Eigen::Vector3d& b_m) const;
  /// The marks of cubes that are in the frame.
  std::vector<PlacedMark> placed(const std::vector<CubeMark>& marks) const;

 private:
  std::optional<int> slot_at(float x, float y) const;
  Eigen::Vector2d frame_pixel(float x, float y) const;
  float scale() const { return area_->width / part_px_.width; }
  void find_part();
  void fill_space(const Rect& space);

  SceneDrawing drawing_;
  std::optional<Eigen::AlignedBox3d> shown_m_;
  int width_px_ = 0, height_px_ = 0;  ///< of the frame
  Rect wanted_px_, part_px_;          ///< parts of the frame: required; displayed
  std::optional<Rect> area_;
};

}  // namespace heft
