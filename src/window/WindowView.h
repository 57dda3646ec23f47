// The participant's window: SDL2 and OpenGL, full screen, for touch at arm's length. Fingers and
// mouse are equal: a tap is going down and up on the same control, or on the same cube in the
// scene, which is as good as its button; when it counts: TouchScreen.h. Targets' sizes: Measures.h.
// F11 changes between full screen and a window. An effector that is to be dragged goes with the
// finger or mouse that went down on it; the wheel turns it.
//
// Keyboard, where it is asked for (whoever types elsewhere must not answer): 1...9 a cube or a
// form's choice; L, I, H lightest, intermediate, heaviest (whatever the language); Enter goes on,
// agrees, validates; D "I don't know"; N "No difference", "I do not agree"; Backspace puts the
// cubes back, or goes back in a form or a text.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "view/ArView.h"
#include "view/screens/TouchScreen.h"
#include "window/EffectorDrag.h"
#include "window/GlWindow.h"
#include "window/Painter.h"

namespace heft {

class WindowView final : public ArView {
 public:
  /// @throws Error (device_missing) without a display, (invalid_file) when no installed font has a
  /// character of the texts
  explicit WindowView(const ViewSetup& setup);

  std::optional<double> present(const ViewFrame& shown, const ScreenState& screen) override;
  std::vector<Touch> wait(double seconds) override;
  std::optional<DisplayFacts> display() const override { return window_.display(); }
  std::optional<bool> is_full_screen() const override { return window_.is_full_screen(); }
  std::optional<double> clone_offset_px() const override { return clone_offset_px_; }

  const Measures& measures() const { return measures_; }
  /// The controls as last shown, in pixels of the window: for tests, and for scripts that tap.
  const std::vector<Control>& controls() const { return touched_.page().controls; }
  /// Whether a finger that goes down there takes the effector, to drag it.
  bool is_on_effector(float x, float y) const;
  /// As TouchScreen::target_at.
  std::optional<std::string> target_at(float x, float y) const { return touched_.target_at(x, y); }

 private:
  void show(const ViewFrame& shown, const ScreenState& screen);
  void draw();
  void handle_pending();
  void handle(const SDL_Event& event);
  std::optional<Eigen::Vector3d> dragged_to(float x, float y) const;
  void moved(Taps::Pointer pointer, float x, float y);
  void down(Taps::Pointer pointer, float x, float y, double t_s);
  void up(Taps::Pointer pointer, float x, float y, double t_s);
  void lay_out();
  Measures measured() const;

  GlWindow window_;
  SceneOnScreen scene_;
  TouchScreen touched_;
  float text_size_;
  std::optional<Patch> patch_;
  Measures measures_;
  Typeface typeface_;
  std::optional<EffectorDrag> drag_;  ///< none: the effector is held, or a model's
  bool in_trial_ = false;
  std::optional<double> clone_offset_px_;
  double sdl_start_s_;  ///< SDL counts events' times from there, in milliseconds of the same clock
  bool stale_ = false;  ///< what is on the display is not the page as it is now
};

}  // namespace heft
