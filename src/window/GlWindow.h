// The window on the display: SDL's window with an OpenGL context, one texture for the scene's
// frame, and Dear ImGui's draw list. WindowView decides what is painted and what events mean. Also
// the functions of WindowModule.
#pragma once

#include <SDL.h>

#include <memory>

#include "base/Image.h"
#include "experiment/Stage.h"
#include "view/Window.h"
#include "view/screens/Page.h"

struct ImDrawList;

namespace heft {

class WrittenTextures;

struct WindowChoice {
  int display = 0;
  bool windowed = false;
  bool hidden = false;  ///< to test whether a window is possible
};

class GlWindow {
 public:
  /// @throws Error (device_missing) with advice if that display is missing, or none can draw
  GlWindow(const char* title, const WindowChoice& choice);
  ~GlWindow();
  GlWindow(const GlWindow&) = delete;
  GlWindow& operator=(const GlWindow&) = delete;

  /// In pixels, which may be smaller than the window system's units.
  Measures measures() const;
  /// Pixels per unit of the window system.
  float scale() const;
  void toggle_full_screen();
  bool is_full_screen() const;
  /// The current display.
  DisplayFacts display() const;
  /// The graphics driver's name.
  std::string renderer() const;

  /// Uploads the frame's pixels (blue, green, red) to the texture.
  void upload(const Image& frame);
  unsigned texture() const;

  /// Begins a frame and returns its draw list.
  /// @throws Error (device_missing) if the graphics context is lost and cannot be restored
  ImDrawList& begin_frame();
  /// Textures of the texts in this frame.
  WrittenTextures& written();
  /// Presents the frame. Returns once the display has it, as far as the driver reports.
  void end_frame();

 private:
  struct Video;     // SDL's video subsystem
  struct Graphics;  // everything that is lost with the OpenGL context
  void renew_graphics();

  std::unique_ptr<Video> video_;
  std::unique_ptr<SDL_Window, void (*)(SDL_Window*)> window_;
  std::unique_ptr<Graphics> graphics_;
  Image last_frame_;  ///< uploaded again if the graphics context was lost
};

// Functions of WindowModule: displays, measuring one with a bank card (CardWindow.cpp), and the
// time from a touch to its answer (TouchDelay.cpp).
std::vector<DisplayFacts> displays();
std::vector<CheckResult> check_displays(const ScreenTexts& texts);
std::optional<MeasuredCard> measure_card(int display, const std::string& how);
std::vector<double> touch_delays_s(const ScreenTexts& texts, const std::function<void()>& keep,
                                   int n_taps);

}  // namespace heft
