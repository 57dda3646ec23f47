// Taps and keys for a WindowView in this process, as SDL events. Controls are found by their stable
// names, also to drive whole sessions.
#pragma once

#include <SDL.h>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "window/WindowView.h"

namespace heft {

inline const Control& control_named(const WindowView& view, const std::string& name) {
  for (const Control& control : view.controls())
    if (control.name == name) return control;
  throw std::out_of_range("no control " + name);
}

inline float center_x(const Rect& area) {
  return area.x + area.width / 2;
}
inline float center_y(const Rect& area) {
  return area.y + area.height / 2;
}

inline void push_finger(Uint32 type, float x, float y, SDL_FingerID finger = 7) {
  int width = 0, height = 0;
  SDL_GetWindowSize(SDL_GL_GetCurrentWindow(), &width, &height);
  SDL_Event event{};
  event.type = type;
  event.tfinger.fingerId = finger;
  event.tfinger.x = x / static_cast<float>(width);
  event.tfinger.y = y / static_cast<float>(height);
  SDL_PushEvent(&event);
}

inline void push_mouse(Uint32 type, float x, float y, Uint32 which = 0) {
  SDL_Event event{};
  event.type = type;
  event.button.which = which;
  event.button.button = SDL_BUTTON_LEFT;
  event.button.x = static_cast<Sint32>(x);
  event.button.y = static_cast<Sint32>(y);
  SDL_PushEvent(&event);
}

inline void push_mouse_motion(float x, float y) {
  SDL_Event event{};
  event.type = SDL_MOUSEMOTION;
  event.motion.x = static_cast<Sint32>(x);
  event.motion.y = static_cast<Sint32>(y);
  SDL_PushEvent(&event);
}

inline void push_wheel(Sint32 notches) {
  SDL_Event event{};
  event.type = SDL_MOUSEWHEEL;
  event.wheel.y = notches;
  SDL_PushEvent(&event);
}

inline void push_key(SDL_Scancode code) {
  SDL_Event event{};
  event.type = SDL_KEYDOWN;
  event.key.keysym.scancode = code;
  event.key.keysym.sym = SDL_GetKeyFromScancode(code);
  SDL_PushEvent(&event);
}

inline void tap_with_finger(float x, float y) {
  push_finger(SDL_FINGERDOWN, x, y);
  push_finger(SDL_FINGERUP, x, y);
}

inline void tap_with_mouse(float x, float y) {
  push_mouse(SDL_MOUSEBUTTONDOWN, x, y);
  push_mouse(SDL_MOUSEBUTTONUP, x, y);
}

inline void tap(const WindowView& view, const std::string& name) {
  const Rect area = control_named(view, name).area;
  tap_with_finger(center_x(area), center_y(area));
}

/// The middle of the pixels in the picture where taps select this cube.
inline std::pair<float, float> place_in_picture(const WindowView& view, const std::string& cube) {
  int width = 0, height = 0;
  SDL_GetWindowSize(SDL_GL_GetCurrentWindow(), &width, &height);
  const Rect button = control_named(view, cube).area;
  constexpr int step_px = 16;
  float x_sum = 0, y_sum = 0, n = 0;
  for (int y = 0; y < height; y += step_px)
    for (int x = 0; x < width; x += step_px) {
      const auto px = static_cast<float>(x), py = static_cast<float>(y);
      if (button.contains(px, py) || view.target_at(px, py) != cube) continue;
      x_sum += px;
      y_sum += py;
      ++n;
    }
  if (n == 0) throw std::out_of_range(cube + " is not in the picture");
  return {x_sum / n, y_sum / n};
}

}  // namespace heft
