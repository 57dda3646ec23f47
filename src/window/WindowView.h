// The participant's window: SDL2 and OpenGL, full screen, for touch at arm's length. Fingers and
// mouse are equivalent: a tap is going down and up on the same control, or on the same cube in the
// scene, which acts as its button. For when it counts see TouchScreen.h, for targets' sizes Page.h.
// F11 toggles full screen. A dragged effector follows the finger or mouse that went down on it or
// on its clone; the wheel or a second finger turns it.
//
// Keyboard, if enabled (other people's typing must not answer): 1...9 a cube or a form's choice; L,
// I, H lightest, intermediate, heaviest (in every language); Enter continues, agrees, validates; D
// "I don't know"; N "No difference", "I do not agree"; Backspace puts the cubes back, or goes back
// in a form or a text.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiment/Stage.h"
#include "view/ArView.h"
#include "view/screens/TouchScreen.h"
#include "window/GlWindow.h"
#include "window/Painter.h"

namespace heft {

/// The dragged effector: taken by a finger or the mouse, at itself or at its clone, moved over the
/// table at constant height, and turned by the wheel or a second finger. The pointer's position is
/// where its ray meets that height.
class EffectorDrag {
 public:
  /// @param setup with the effector
  explicit EffectorDrag(const ViewSetup& setup);

  /// Height at which pointers are projected.
  double height_m() const { return effector_->pose.position_m.z(); }

  /// Sets the displayed clone, which may be all of the effector that the participant sees.
  void set_clone(const std::optional<Pose>& clone) { clone_ = clone; }

  /// Whether a point is over the effector or its clone. @param at_m board frame, at height_m()
  bool is_at(const Eigen::Vector3d& at_m) const;

  /// Takes the effector if the pointer is over it and no other pointer has it. While one has it,
  /// a second finger anywhere turns it.
  void take(Taps::Pointer pointer, const Eigen::Vector3d& at_m);
  /// Moves the effector with the pointer that has it, within the working area; a second finger's
  /// movement about the first turns it.
  void move(Taps::Pointer pointer, const Eigen::Vector3d& at_m);
  void let_go(Taps::Pointer pointer);
  void let_go() { holder_.reset(), turner_.reset(); }
  bool is_held() const { return holder_.has_value(); }
  bool is_held_by(Taps::Pointer pointer) const { return holder_ == pointer || turner_ == pointer; }

  /// Turns it about the vertical axis, counterclockwise as seen from above.
  void turn(double notches);

  /// Whether it was ever taken, after which no hint is needed.
  bool was_taken() const { return was_taken_; }

 private:
  void turn_by(double angle_rad);

  std::shared_ptr<DraggedEffector> effector_;
  std::optional<Pose> clone_;
  Eigen::Vector2d half_m_, reach_m_;
  std::optional<Taps::Pointer> holder_, turner_;
  Eigen::Vector3d from_pointer_m_{0, 0, 0};
  Eigen::Vector2d held_at_m_{0, 0}, turned_at_m_{0, 0};  // the two pointers
  bool was_taken_ = false;
};

class WindowView final : public ArView {
 public:
  /// @throws Error (device_missing) without a display, (invalid_file) if no installed font has a
  ///   character of the texts
  explicit WindowView(const ViewSetup& setup);

  std::optional<double> present(const ViewFrame& shown, const ScreenState& screen) override;
  std::vector<Touch> wait(double seconds) override;
  std::optional<DisplayFacts> display() const override { return window_.display(); }
  std::optional<bool> is_full_screen() const override { return window_.is_full_screen(); }
  std::optional<double> clone_offset_px() const override { return clone_offset_px_; }

  const Measures& measures() const { return measures_; }
  /// The displayed controls, in pixels of the window, for tests and scripts that tap.
  const std::vector<Control>& controls() const { return touched_.page().controls; }
  /// Whether a finger that goes down there takes the effector, or turns it.
  bool is_on_effector(float x, float y) const;
  /// See TouchScreen::target_at.
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
  std::optional<EffectorDrag> drag_;  ///< none: the effector is not dragged
  bool in_trial_ = false;
  std::string caption_;  ///< of a replay
  std::optional<double> clone_offset_px_;
  double sdl_start_s_;  ///< start of SDL's event times, which are in milliseconds of the same clock
  bool stale_ = false;  ///< the page has changed since it was presented
};

}  // namespace heft
