// The participant's pages under simulated fingers, with simulated time: the program's own code from
// the position of a touch to the session, without window system and drawing.
#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "view/ArView.h"
#include "view/screens/TouchScreen.h"

namespace heft::testing {

/// The simulated time, seconds.
inline double made_up_s = 0;
inline double made_up_monotonic() {
  return made_up_s;
}

/// A finger that goes down and up at one place.
struct Tap {
  double down_s = 0, up_s = 0;
  float x = 0, y = 0;
};

class TappedScreen final : public ArView {
 public:
  /// Asked for the next tap whenever the one before is over; its times are not before now.
  using NextTap = std::function<std::optional<Tap>(const TappedScreen&)>;

  TappedScreen(const ScreenTexts& texts, NextTap next_tap, Measures window = {1024, 600},
               bool left_handed = false)
      : measures(window),
        next_tap_(std::move(next_tap)),
        typeface_(texts),
        touched_(texts, left_handed, false, [](float, float) { return std::nullopt; }) {}

  std::optional<double> present(const ViewFrame& frame, const ScreenState& screen) override {
    constexpr double drawing_s = 0.004;
    touched_.show(screen, !frame.frame.cubes.empty());
    made_up_s += drawing_s;
    screen_ = screen;
    draw();
    return made_up_s;
  }

  std::vector<Touch> wait(double seconds) override {
    constexpr double tick_s = 1e-4;  // what is less than that, no clock would be waited for
    const double end_s = made_up_s + std::max(seconds, tick_s);
    while (!touched_.has_touches() && move_finger(end_s)) draw();
    if (!touched_.has_touches()) made_up_s = end_s;
    return touched_.take();
  }

  const Page& page() const { return touched_.page(); }
  /// Null: the page has none of that name.
  const Control* control(const std::string& name) const {
    const auto found = std::ranges::find(page().controls, name, &Control::name);
    return found == page().controls.end() ? nullptr : &*found;
  }
  const ScreenState& screen() const { return screen_; }

  const Measures measures;
  /// The effect of each tap: number of touches for the session, and whether it turned a part or
  /// chose a cube.
  struct Done {
    Tap tap;
    std::string control;
    std::size_t n_touches = 0;
    bool changed_page = false;
  };
  std::vector<Done> done;

 private:
  void draw() {
    touched_.lay_out(typeface_, measures, made_up_s);
    touched_.presented(made_up_s);
  }

  // The contents of the page, without what is pressed.
  static std::string look(const Page& page) {
    std::string all;
    for (const TextLine& line : page.lines) all += line.text + '\n';
    for (const Control& control : page.controls)
      all += control.name + (control.chosen ? "+" : "") + '\n';
    return all;
  }

  // Carries out the finger's next movement before a time. @return false: there is none
  bool move_finger(double end_s) {
    if (!tap_) tap_ = next_tap_(*this);
    if (!tap_ || (is_down_ ? tap_->up_s : tap_->down_s) > end_s) return false;
    made_up_s = std::max(made_up_s, is_down_ ? tap_->up_s : tap_->down_s);
    if (!is_down_)
      touched_.down(Taps::mouse, tap_->x, tap_->y, made_up_s);
    else
      lift();
    is_down_ = !is_down_;
    return true;
  }

  void lift() {
    const std::string before = look(page()), control = control_at(tap_->x, tap_->y);
    touched_.up(Taps::mouse, tap_->x, tap_->y, made_up_s);
    std::vector<Touch> touches = touched_.take();
    const std::size_t n = touches.size();
    for (Touch& touch : touches) touched_.report(touch, made_up_s);
    touched_.lay_out(typeface_, measures, made_up_s);
    done.push_back({*tap_, control, n, look(page()) != before});
    tap_.reset();
  }

  std::string control_at(float x, float y) const {
    for (const Control& control : page().controls)
      if (control.area.contains(x, y)) return control.name;
    return "";
  }

  NextTap next_tap_;
  Typeface typeface_;
  TouchScreen touched_;
  ScreenState screen_;
  std::optional<Tap> tap_;
  bool is_down_ = false;
};

}  // namespace heft::testing
