// The window on the display: SDL's window with an OpenGL context, one texture for the scene's
// frame, and Dear ImGui's draw list to paint with. What is painted, and what events mean, is for
// WindowView.
#pragma once

#include <SDL.h>

#include <memory>

#include "base/Image.h"
#include "experiment/Stage.h"
#include "view/screens/Page.h"
#include "window/WrittenTextures.h"

struct ImDrawList;

namespace heft {

/// Fingers can touch so many devices.
int touch_devices();

struct WindowChoice {
  int display = 0;
  bool windowed = false;
  bool hidden = false;  ///< to see whether one can be had
};

class GlWindow {
 public:
  /// @throws Error (device_missing) saying what to do when there is no such display, or none that
  ///   can draw
  GlWindow(const char* title, const WindowChoice& choice);
  ~GlWindow();
  GlWindow(const GlWindow&) = delete;
  GlWindow& operator=(const GlWindow&) = delete;

  /// In pixels, which can be more than the window system's units.
  Measures measures() const;
  /// Pixels a unit of the window system.
  float scale() const;
  void toggle_full_screen();
  bool is_full_screen() const;
  /// The display that it is on now.
  DisplayFacts display() const;
  /// What draws, as the driver calls it.
  std::string renderer() const;

  /// Makes the frame's pixels (blue, green, red) the texture.
  void upload(const Image& frame);
  unsigned texture() const;

  /// Begins a frame, to be painted on the list that it gives.
  /// @throws Error (device_missing) when the graphics are lost and can't be had again
  ImDrawList& begin_frame();
  /// For what is written in this frame.
  WrittenTextures& written();
  /// Shows what was painted. Returns once the display has it, as far as the driver tells.
  void end_frame();

 private:
  struct Video;     // SDL's video part, while there is a window
  struct Graphics;  // all that is lost with the OpenGL context
  void renew_graphics();

  std::unique_ptr<Video> video_;
  std::unique_ptr<SDL_Window, void (*)(SDL_Window*)> window_;
  std::unique_ptr<Graphics> graphics_;
  Image last_frame_;  ///< to upload again when the graphics were lost
};

}  // namespace heft
