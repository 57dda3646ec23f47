#include "window/WindowView.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/Clock.h"

namespace heft {

namespace {
// A finger this far from a cube, in targets, still touches it.
constexpr float around = 0.35f;

std::optional<char> key_of(const SDL_Keysym& key) {
  // Digits by their position: on a French keyboard they need no shift here.
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
      touched_(
          setup.texts, setup.left_handed, setup.takes_keys,
          [this](float x, float y) { return scene_.slot_near(x, y, around * measures_.target); }),
      text_size_(static_cast<float>(setup.text_size)),
      measures_(measured()),
      typeface_(setup.texts),
      sdl_start_s_(monotonic_s() - static_cast<double>(SDL_GetTicks64()) * 1e-3) {
  if (setup.dragged) drag_.emplace(setup);
  if (setup.patch) patch_ = Patch{false, !setup.left_handed};
}

void WindowView::show(const ViewFrame& shown, const ScreenState& screen) {
  touched_.show(screen, !shown.frame.cubes.empty());
  in_trial_ = screen.screen == Screen::trial && !screen.is_check;
  if (drag_) drag_->set_clone(shown.frame.clone);
  if (drag_ && !in_trial_) drag_->let_go();
  caption_ = fmt::format("{}", fmt::join(shown.captions, "\n\n"));
  lay_out();
  clone_offset_px_.reset();
  if (!touched_.page().scene) return;
  window_.upload(scene_.draw(shown));
  scene_.place(touched_.page().scene);
  if (shown.frame.tracked && shown.frame.clone)
    clone_offset_px_ =
        scene_.distance_px(shown.frame.effector.position_m, shown.frame.clone->position_m);
}

Measures WindowView::measured() const {
  const Measures window = window_.measures();
  return {window.width, window.height, text_size_};
}

// Lays out the page for the current window size and state of the screens.
void WindowView::lay_out() {
  measures_ = measured();
  const bool untried = drag_ && in_trial_ && !drag_->was_taken();
  touched_.lay_out(typeface_, measures_, monotonic_s(),
                   untried ? touched_.texts().if_any("trial", "drag_effector") : caption_);
  scene_.place(touched_.page().scene);
  stale_ = true;
}

void WindowView::draw() {
  const Page& page = touched_.page();
  std::optional<PaintedScene> painted;
  if (scene_.area())
    painted = PaintedScene{window_.texture(), *scene_.area(), scene_.part(), page.scene_opacity};
  ImDrawList& list = window_.begin_frame();
  paint_page(
      list, page,
      {typeface_, measures_, window_.written(), painted, scene_.placed(page.marks),
       [&](const std::string& name) { return touched_.holds(name); },
       [&, now_s = monotonic_s()](const std::string& name) { return touched_.takes(name, now_s); },
       patch_});
  window_.end_frame();
  touched_.presented(monotonic_s());
  stale_ = false;
}

// The dragging pointer's point at the effector's height.
std::optional<Eigen::Vector3d> WindowView::dragged_to(float x, float y) const {
  return drag_ ? scene_.point_at_height(x, y, drag_->height_m()) : std::nullopt;
}

bool WindowView::is_on_effector(float x, float y) const {
  if (!in_trial_ || !scene_.area() || !scene_.area()->contains(x, y)) return false;
  const auto at_m = dragged_to(x, y);
  if (!at_m) return false;
  // While the effector is held, a second finger turns it unless it taps a cube.
  return drag_->is_held() ? !target_at(x, y) : drag_->is_at(*at_m);
}

void WindowView::down(Taps::Pointer pointer, float x, float y, double t_s) {
  if (is_on_effector(x, y)) {  // at any time: it is not an answer
    drag_->take(pointer, *dragged_to(x, y));
    lay_out();
  } else if (touched_.down(pointer, x, y, t_s)) {
    stale_ = true;
  }
}

void WindowView::moved(Taps::Pointer pointer, float x, float y) {
  if (const auto at_m = dragged_to(x, y)) drag_->move(pointer, *at_m);
}

void WindowView::up(Taps::Pointer pointer, float x, float y, double t_s) {
  if (drag_ && drag_->is_held_by(pointer))
    drag_->let_go(pointer);
  else if (touched_.up(pointer, x, y, t_s))
    lay_out();
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
      if (const auto pressed = key_of(event.key.keysym); pressed && touched_.key(*pressed, t_s))
        lay_out();
      return;
    case SDL_WINDOWEVENT:
      return lay_out();  // perhaps resized or uncovered
    case SDL_QUIT:
      return touched_.report(touch_of(TouchKind::close), t_s);
  }
}

void WindowView::handle_pending() {
  for (SDL_Event event; SDL_PollEvent(&event) != 0;) handle(event);
}

std::optional<double> WindowView::present(const ViewFrame& shown, const ScreenState& screen) {
  handle_pending();  // earlier taps belong to the previous page
  show(shown, screen);
  if (patch_) patch_->white = !patch_->white;  // repetitions in between show the same frame
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
    if (touched_.has_touches() || left_s <= 0) break;
    SDL_WaitEventTimeout(nullptr, static_cast<int>(std::ceil(left_s * 1e3)));
  }
  return touched_.take();
}

namespace {
// A finger this far beside the effector still takes it.
constexpr double around_m = 0.01;
constexpr double turn_rad = 5 * std::numbers::pi / 180;  // per notch of the wheel
}  // namespace

EffectorDrag::EffectorDrag(const ViewSetup& setup)
    : effector_(setup.dragged),
      half_m_(setup.stage.effector_size_m.head<2>() / 2),
      reach_m_(setup.area_m / 2) {}

bool EffectorDrag::is_at(const Eigen::Vector3d& at_m) const {
  const auto is_over = [&](const Pose& pose) {
    const Eigen::Vector3d in_box_m = pose.orientation.conjugate() * (at_m - pose.position_m);
    return ((in_box_m.head<2>().cwiseAbs() - half_m_).array() <= around_m).all();
  };
  return is_over(effector_->pose) || (clone_ && is_over(*clone_));
}

void EffectorDrag::take(Taps::Pointer pointer, const Eigen::Vector3d& at_m) {
  if (holder_) {
    if (turner_) return;
    turner_ = pointer;
    turned_at_m_ = at_m.head<2>();
  } else if (is_at(at_m)) {
    holder_ = pointer;
    held_at_m_ = at_m.head<2>();
    from_pointer_m_ = effector_->pose.position_m - at_m;
    was_taken_ = true;
  }
}

void EffectorDrag::move(Taps::Pointer pointer, const Eigen::Vector3d& at_m) {
  if (!is_held_by(pointer)) return;
  const auto angle_rad = [&] {
    const Eigen::Vector2d along_m = turned_at_m_ - held_at_m_;
    return std::atan2(along_m.y(), along_m.x());
  };
  const double before_rad = angle_rad();
  (holder_ == pointer ? held_at_m_ : turned_at_m_) = at_m.head<2>();
  if (turner_) turn_by(angle_rad() - before_rad);
  if (holder_ != pointer) return;
  const Eigen::Vector2d to_m = (at_m + from_pointer_m_).head<2>();
  effector_->pose.position_m.head<2>() = to_m.cwiseMax(-reach_m_).cwiseMin(reach_m_);
}

void EffectorDrag::let_go(Taps::Pointer pointer) {
  if (holder_ == pointer) let_go();
  if (turner_ == pointer) turner_.reset();
}

void EffectorDrag::turn(double notches) {
  turn_by(notches * turn_rad);
}

void EffectorDrag::turn_by(double angle_rad) {
  Eigen::Quaterniond& orientation = effector_->pose.orientation;
  const Eigen::AngleAxisd turned(angle_rad, Eigen::Vector3d::UnitZ());
  orientation = (turned * orientation).normalized();
}

}  // namespace heft
