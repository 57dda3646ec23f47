#include "view/window/WindowView.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/Clock.h"

namespace heft {

namespace {
// A page that just appeared was not what a finger already on its way meant: the second half of a
// double tap must not skip instructions. Shorter than people take to react to anything.
constexpr double settle_s = 0.2;

// Fingers are broader than a cube's edge: this far from a cube, in targets, still means it.
constexpr float around = 0.35f;

std::optional<char> key_of(const SDL_Keysym& key) {
  // Digits by their place: on a French keyboard they need no shift here.
  if (key.scancode >= SDL_SCANCODE_1 && key.scancode <= SDL_SCANCODE_9)
    return static_cast<char>('1' + (key.scancode - SDL_SCANCODE_1));
  if (key.scancode >= SDL_SCANCODE_KP_1 && key.scancode <= SDL_SCANCODE_KP_9)
    return static_cast<char>('1' + (key.scancode - SDL_SCANCODE_KP_1));
  if (key.scancode == SDL_SCANCODE_KP_ENTER) return key_enter;
  if (key.sym > 0 && key.sym < 128) return static_cast<char>(key.sym);
  return std::nullopt;
}
}  // namespace

WindowView::WindowView(const ViewSetup& setup)
    : window_("Heft", {setup.display, setup.windowed}),
      scene_(setup),
      screens_(setup.texts, setup.left_handed),
      measures_(window_.measures()),
      typeface_(std::make_unique<Typeface>(setup.texts, measures_)),
      sdl_start_s_(monotonic_s() - static_cast<double>(SDL_GetTicks64()) * 1e-3) {
  if (setup.dragged) drag_.emplace(setup);
}

void WindowView::show(const ViewFrame& shown, const ScreenState& screen) {
  if (screens_.show(screen, !shown.frame.cubes.empty())) {
    taps_.forget();
    page_since_s_ = monotonic_s();
  }
  in_trial_ = screen.screen == Screen::trial;
  if (drag_ && !in_trial_) drag_->let_go();
  lay_out();
  clone_offset_px_.reset();
  if (!page_.scene) return;
  window_.upload(scene_.draw(shown));
  scene_.place(page_.scene);
  if (shown.frame.tracked && shown.frame.clone)
    clone_offset_px_ =
        scene_.distance_px(shown.frame.effector.position_m, shown.frame.clone->position_m);
}

// The page for the window's size and the screens' memory as they are now.
void WindowView::lay_out() {
  const Measures now = window_.measures();
  if (now.width != measures_.width || now.height != measures_.height) {
    measures_ = now;
    typeface_ = std::make_unique<Typeface>(screens_.texts(), measures_);
  }
  page_ = screens_.page(*typeface_, measures_);
  if (drag_ && in_trial_ && !drag_->was_taken())
    if (const std::string& hint = screens_.texts().if_any("trial", "drag_effector"); !hint.empty())
      page_.notice = hint;
  scene_.place(page_.scene);
  stale_ = true;
}

void WindowView::draw() {
  std::optional<PaintedScene> painted;
  if (scene_.area()) painted = PaintedScene{window_.texture(), *scene_.area(), scene_.part()};
  ImDrawList& list = window_.begin_frame(typeface_->atlas());
  paint_page(list, page_,
             {*typeface_, measures_, painted, scene_.placed(page_.marks),
              [&](const std::string& name) { return taps_.holds(name); }});
  window_.end_frame();
  stale_ = false;
}

const Control* WindowView::enabled_control(const std::string& name) const {
  const auto found = std::ranges::find(page_.controls, name, &Control::name);
  return found != page_.controls.end() && found->enabled ? &*found : nullptr;
}

std::optional<std::string> WindowView::target_at(float x, float y) const {
  for (const Control& control : page_.controls)
    if (control.area.contains(x, y))
      return control.enabled ? std::optional(control.name) : std::nullopt;
  const auto slot = scene_.slot_near(x, y, around * measures_.target);
  if (!slot) return std::nullopt;
  const std::string name = fmt::format("cube_{}", *slot);
  return enabled_control(name) ? std::optional(name) : std::nullopt;
}

// Where a pointer that drags the effector is, at its height.
std::optional<Eigen::Vector3d> WindowView::dragged_to(float x, float y) const {
  return drag_ ? scene_.point_at_height(x, y, drag_->height_m()) : std::nullopt;
}

bool WindowView::is_on_effector(float x, float y) const {
  if (!in_trial_ || !scene_.area() || !scene_.area()->contains(x, y)) return false;
  const auto at_m = dragged_to(x, y);
  return at_m && drag_->is_at(*at_m);
}

void WindowView::moved(Taps::Pointer pointer, float x, float y) {
  if (const auto at_m = dragged_to(x, y)) drag_->move(pointer, *at_m);
}

void WindowView::down(Taps::Pointer pointer, float x, float y, double t_s) {
  if (is_on_effector(x, y)) {  // at any time: it answers nothing
    drag_->take(pointer, *dragged_to(x, y));
    return lay_out();
  }
  if (t_s < page_since_s_ + settle_s) return;
  if (const auto target = target_at(x, y)) {
    taps_.down(pointer, *target);
    stale_ = true;
  }
}

void WindowView::up(Taps::Pointer pointer, float x, float y, double t_s) {
  if (drag_ && drag_->is_held_by(pointer)) return drag_->let_go(pointer);
  const auto target = target_at(x, y);
  stale_ = true;
  if (taps_.up(pointer, target)) apply(*enabled_control(*target), t_s);
}

void WindowView::key(char key, double t_s) {
  if (t_s < page_since_s_ + settle_s) return;
  const auto found = std::ranges::find_if(page_.controls, [&](const Control& control) {
    return control.key == key && control.enabled;
  });
  if (found != page_.controls.end()) apply(*found, t_s);
}

void WindowView::apply(const Control& control, double t_s) {
  if (auto touch = screens_.tapped(control)) report(std::move(*touch), t_s);
  lay_out();
}

void WindowView::report(Touch touch, double t_s) {
  touch.monotonic_s = t_s;
  touches_.push_back(std::move(touch));
}

void WindowView::handle(const SDL_Event& event) {
  const double t_s = sdl_start_s_ + event.common.timestamp * 1e-3;
  const auto mouse_at = [&](Sint32 place) { return static_cast<float>(place) * window_.scale(); };
  switch (event.type) {
    case SDL_FINGERDOWN:
      SDL_ShowCursor(SDL_DISABLE);
      return down(event.tfinger.fingerId, event.tfinger.x * measures_.width,
                  event.tfinger.y * measures_.height, t_s);
    case SDL_FINGERUP:
      return up(event.tfinger.fingerId, event.tfinger.x * measures_.width,
                event.tfinger.y * measures_.height, t_s);
    case SDL_FINGERMOTION:
      return moved(event.tfinger.fingerId, event.tfinger.x * measures_.width,
                   event.tfinger.y * measures_.height);
    case SDL_MOUSEMOTION:
      SDL_ShowCursor(SDL_ENABLE);
      if (event.motion.which != SDL_TOUCH_MOUSEID)
        moved(Taps::mouse, mouse_at(event.motion.x), mouse_at(event.motion.y));
      return;
    case SDL_MOUSEWHEEL:
      if (drag_ && in_trial_) drag_->turn(event.wheel.y);
      return;
    case SDL_MOUSEBUTTONDOWN:
      if (event.button.button == SDL_BUTTON_LEFT && event.button.which != SDL_TOUCH_MOUSEID)
        down(Taps::mouse, mouse_at(event.button.x), mouse_at(event.button.y), t_s);
      return;
    case SDL_MOUSEBUTTONUP:
      if (event.button.button == SDL_BUTTON_LEFT && event.button.which != SDL_TOUCH_MOUSEID)
        up(Taps::mouse, mouse_at(event.button.x), mouse_at(event.button.y), t_s);
      return;
    case SDL_KEYDOWN:
      if (event.key.repeat != 0) return;
      if (event.key.keysym.sym == SDLK_F11) return window_.toggle_full_screen();
      if (const auto pressed = key_of(event.key.keysym)) key(*pressed, t_s);
      return;
    case SDL_WINDOWEVENT:
      return lay_out();  // perhaps resized, perhaps uncovered
    case SDL_QUIT:
      return report(touch_of(TouchKind::close), t_s);
  }
}

void WindowView::handle_pending() {
  for (SDL_Event event; SDL_PollEvent(&event) != 0;) handle(event);
}

std::optional<double> WindowView::present(const ViewFrame& shown, const ScreenState& screen) {
  handle_pending();  // what was tapped so far was meant for the page before
  show(shown, screen);
  draw();
  const double presented_s = monotonic_s();
  SDL_PumpEvents();  // events get their times here
  return presented_s;
}

std::vector<Touch> WindowView::wait(double seconds) {
  const double end_s = monotonic_s() + seconds;
  for (;;) {
    handle_pending();
    if (stale_) draw();
    const double left_s = end_s - monotonic_s();
    if (!touches_.empty() || left_s <= 0) break;
    SDL_WaitEventTimeout(nullptr, static_cast<int>(std::ceil(left_s * 1e3)));
  }
  return std::exchange(touches_, {});
}

}  // namespace heft
