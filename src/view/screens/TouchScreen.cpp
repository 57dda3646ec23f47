#include "view/screens/TouchScreen.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace heft {

namespace {
Effect slid_to(const Slide& slide, float fraction) {
  constexpr float most = 100;
  const float set = slide.from_the_right ? 1 - fraction : fraction;
  const std::string value = std::to_string(std::lround(most * std::clamp(set, 0.f, 1.f)));
  if (slide.typed) return Typed{slide.key, value};
  return entry_touch(slide.key, value);
}
}  // namespace

// The gap after a trial separates taps, and the engine logs answers that come too early. Hence a
// trial's page takes presses as soon as it is visible.
void TouchScreen::show(const ScreenState& state, bool cubes_shown) {
  const bool after_a_trial = screens_.page_id().screen == Screen::trial &&
                             state.screen == Screen::trial && !state.try_again;
  switch (screens_.show(state, cubes_shown)) {
    case Turn::none:
      return;
    case Turn::cubes:
      return turn(0);
    case Turn::page:
      return turn(after_a_trial ? 0 : settle_s);
  }
}

void TouchScreen::turn(double settles_s) {
  taps_.forget();
  presented_ = false;
  settles_s_ = settles_s;
}

void TouchScreen::lay_out(const Typeface& typeface, const Measures& measures, double now_s,
                          const std::string& hint) {
  page_ = screens_.page(typeface, measures, presented_ ? now_s - since_s_ : 0);
  page_.hint = hint;
}

void TouchScreen::presented(double t_s) {
  if (std::exchange(presented_, true)) return;
  since_s_ = t_s;
  live_from_s_ = t_s + settles_s_;
}

bool TouchScreen::takes(const std::string& control, double t_s) const {
  if (!presented_ || t_s < live_from_s_) return false;
  if (!tapped_ || tapped_->control != control) return true;
  const Control* found = enabled_control(control);
  const bool is_typing = found != nullptr && std::holds_alternative<Typed>(found->effect);
  return t_s >= tapped_->t_s + (is_typing ? key_settle_s : settle_s);
}

bool TouchScreen::down(Taps::Pointer pointer, float x, float y, double t_s) {
  const auto target = target_at(x, y);
  if (!target || !takes(*target, t_s)) return false;
  taps_.down(pointer, *target);
  return true;
}

bool TouchScreen::up(Taps::Pointer pointer, float x, float y, double t_s) {
  const auto target = target_at(x, y);
  if (taps_.up(pointer, target)) apply(*enabled_control(*target), x, t_s);
  return true;
}

bool TouchScreen::key(char key, double t_s) {
  if (!takes_keys_) return false;
  const auto found = std::ranges::find_if(page_.controls, [&](const Control& control) {
    return control.key == key && control.enabled;
  });
  if (found == page_.controls.end() || !takes(found->name, t_s)) return false;
  apply(*found, found->area.x + found->area.width / 2, t_s);
  return true;
}

void TouchScreen::apply(Control control, float x, double t_s) {
  tapped_ = {control.name, t_s};
  if (const auto* slide = std::get_if<Slide>(&control.effect))
    control.effect = slid_to(Slide(*slide), (x - control.area.x) / control.area.width);
  if (std::holds_alternative<TurnPart>(control.effect)) turn(settle_s);
  if (control.entered) report(*control.entered, t_s);
  if (auto touch = screens_.tapped(control)) report(std::move(*touch), t_s);
}

void TouchScreen::report(Touch touch, double t_s) {
  touch.monotonic_s = t_s;
  touch.page = screens_.page_id();
  touches_.push_back(std::move(touch));
}

const Control* TouchScreen::enabled_control(const std::string& name) const {
  const auto found = std::ranges::find(page_.controls, name, &Control::name);
  return found != page_.controls.end() && found->enabled ? &*found : nullptr;
}

std::optional<std::string> TouchScreen::target_at(float x, float y) const {
  for (const Control& control : page_.controls)
    if (control.area.contains(x, y))
      return control.enabled ? std::optional(control.name) : std::nullopt;
  const auto slot = cube_at_(x, y);
  if (!slot) return std::nullopt;
  const std::string name = fmt::format("cube_{}", *slot);
  return enabled_control(name) ? std::optional(name) : std::nullopt;
}

}  // namespace heft
