// A page under fingers: which touches count, and their meaning. A tap counts if it began on the
// page that it answers, after that page was displayed; the second tap of a double tap is ignored.
// Independent of windows: WindowView passes the events with their times.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "view/screens/Screens.h"

namespace heft {

/// Taps are ignored for this long after a page, part or question has turned, and on a control that
/// was just tapped. The taps of a double tap are at most 0.6 s apart.
inline constexpr double settle_s = 0.7;
/// Keys of a number being typed count again after this time, so that 100 can be typed quickly.
/// Longer than the bounce of a touch screen, shorter than the fastest double tap.
inline constexpr double key_settle_s = 0.1;

class TouchScreen {
 public:
  /// The cube in the scene that a finger at this pixel touches.
  using CubeAt = std::function<std::optional<int>(float x, float y)>;

  /// @param takes_keys see ViewSetup
  TouchScreen(ScreenTexts texts, bool left_handed, bool takes_keys, CubeAt cube_at)
      : screens_(std::move(texts), left_handed),
        cube_at_(std::move(cube_at)),
        takes_keys_(takes_keys) {}

  /// Sets the session's state and whether the scene has cubes. Takes effect once presented.
  void show(const ScreenState& state, bool cubes_shown);
  /// Lays out the page for a time. @param hint over the scene
  void lay_out(const Typeface& typeface, const Measures& measures, double now_s,
               const std::string& hint = {});
  /// Reports that the last layout is on the display.
  void presented(double t_s);

  // Events of a finger or the mouse, in pixels; each returns whether the page may have changed.
  bool down(Taps::Pointer pointer, float x, float y, double t_s);
  bool up(Taps::Pointer pointer, float x, float y, double t_s);
  bool key(char key, double t_s);

  /// Returns and clears the touches to report, in order.
  std::vector<Touch> take() { return std::exchange(touches_, {}); }
  bool has_touches() const { return !touches_.empty(); }
  /// Adds a touch that is on no page: the window was closed.
  void report(Touch touch, double t_s);

  const Page& page() const { return page_; }
  const ScreenTexts& texts() const { return screens_.texts(); }
  bool holds(const std::string& control) const { return taps_.holds(control); }
  /// Whether a press of an enabled control counts at this time. The painter shows the others
  /// dimmed.
  bool takes(const std::string& control, double t_s) const;
  /// The name of the enabled control at this pixel; a cube in the scene has its button's name.
  std::optional<std::string> target_at(float x, float y) const;

 private:
  struct Tapped {
    std::string control;
    double t_s = 0;
  };

  const Control* enabled_control(const std::string& name) const;
  /// @param x of the tap
  void apply(Control control, float x, double t_s);
  void turn(double settles_s);

  Screens screens_;
  CubeAt cube_at_;
  bool takes_keys_;
  Page page_;
  Taps taps_;
  std::vector<Touch> touches_;
  double settles_s_ = 0;          // after its presentation
  bool presented_ = false;        // the current page
  double since_s_ = 0;            // presentation of the part
  double live_from_s_ = 0;        // earlier presses do not count
  std::optional<Tapped> tapped_;  // the last tap
};

}  // namespace heft
