// A page under fingers: which touches of it count, and what they mean. A tap counts if it began on
// the page that it answers, after that page was on the display; the second tap of two does nothing.
// Knows nothing of windows: WindowView gives it the events, with their times.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "view/screens/Screens.h"

namespace heft {

/// So long nothing more is taken of a page that was turned, of a part or question that was turned,
/// or of a control that was tapped. The taps of a double tap are at most 0.6 s apart.
inline constexpr double settle_s = 0.7;

class TouchScreen {
 public:
  /// The cube in the scene that a finger at this pixel means.
  using CubeAt = std::function<std::optional<int>(float x, float y)>;

  /// @param takes_keys as ViewSetup
  TouchScreen(ScreenTexts texts, bool left_handed, bool takes_keys, CubeAt cube_at)
      : screens_(std::move(texts), left_handed),
        cube_at_(std::move(cube_at)),
        takes_keys_(takes_keys) {}

  /// What the session offers now, and whether the scene has cubes. It counts once it is presented.
  void show(const ScreenState& state, bool cubes_shown);
  /// Makes the page as it is at a time. @param hint over the scene
  void lay_out(const Typeface& typeface, const Measures& measures, double now_s,
               const std::string& hint = {});
  /// The page as laid out last is on the display.
  void presented(double t_s);

  // Of a finger or the mouse, in pixels; each returns whether the page may look different now.
  bool down(Taps::Pointer pointer, float x, float y, double t_s);
  bool up(Taps::Pointer pointer, float x, float y, double t_s);
  bool key(char key, double t_s);

  /// What the session must know, in order; forgets it.
  std::vector<Touch> take() { return std::exchange(touches_, {}); }
  bool has_touches() const { return !touches_.empty(); }
  /// Something that is on no page: the window was closed.
  void report(Touch touch, double t_s);

  const Page& page() const { return page_; }
  const ScreenTexts& texts() const { return screens_.texts(); }
  bool holds(const std::string& control) const { return taps_.holds(control); }
  /// The name of the enabled control that a tap at this pixel is for; a cube in the scene goes by
  /// its button's name.
  std::optional<std::string> target_at(float x, float y) const;

 private:
  struct Tapped {
    std::string control;
    double t_s = 0;
  };

  bool takes(const std::string& control, double t_s) const;
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
  double settles_s_ = 0;          // once it is presented
  bool presented_ = false;        // as it is now
  double since_s_ = 0;            // that the part was presented
  double live_from_s_ = 0;        // presses before do not count
  std::optional<Tapped> tapped_;  // last
};

}  // namespace heft
