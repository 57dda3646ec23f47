#include "view/window/WindowView.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/Clock.h"
#include "view/window/GlWindow.h"
#include "view/window/Painter.h"
#include "view/window/SceneOnScreen.h"
#include "view/window/Screens.h"
#include "view/window/Taps.h"

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

// SDL counts events' times in milliseconds of the same clock, from its own start.
double sdl_start_s() {
  return monotonic_s() - static_cast<double>(SDL_GetTicks64()) * 1e-3;
}
}  // namespace

struct WindowView::Impl {
  explicit Impl(const ViewSetup& setup)
      : window("Heft"),
        scene(setup),
        screens(setup.texts, setup.left_handed),
        measures(window.measures()),
        typeface(std::make_unique<Typeface>(setup.texts, measures)),
        sdl_start(sdl_start_s()) {}

  void show(const ViewPicture& shown, const ScreenState& screen);
  void draw();
  void handle_pending();
  void handle(const SDL_Event& event);
  void down(Taps::Pointer pointer, float x, float y, double t_s);
  void up(Taps::Pointer pointer, float x, float y, double t_s);
  void key(char key, double t_s);
  void apply(const Control& control, double t_s);
  void report(Touch touch, double t_s);

  void lay_out();
  const Control* enabled_control(const std::string& name) const;
  std::optional<std::string> target_at(float x, float y) const;

  GlWindow window;
  SceneOnScreen scene;
  Screens screens;
  Measures measures;
  std::unique_ptr<Typeface> typeface;
  Page page;
  Taps taps;
  std::vector<Touch> touches;
  double sdl_start;
  double page_since_s = 0;
  bool stale = false;  ///< what is on the display is not the page as it is now
};

void WindowView::Impl::show(const ViewPicture& shown, const ScreenState& screen) {
  if (screens.show(screen, !shown.frame.cubes.empty())) {
    taps.forget();
    page_since_s = monotonic_s();
  }
  lay_out();
  if (!page.scene) return;
  window.upload(scene.draw(shown));
  scene.place(page.scene);
}

// The page for the window's size and the screens' memory as they are now.
void WindowView::Impl::lay_out() {
  const Measures now = window.measures();
  if (now.width != measures.width || now.height != measures.height) {
    measures = now;
    typeface = std::make_unique<Typeface>(screens.texts(), measures);
  }
  page = screens.page(*typeface, measures);
  scene.place(page.scene);
  stale = true;
}

void WindowView::Impl::draw() {
  std::optional<PaintedScene> painted;
  if (scene.area()) painted = PaintedScene{window.texture(), *scene.area()};
  ImDrawList& list = window.begin_frame(typeface->atlas());
  paint_page(list, page,
             {*typeface, measures, painted, scene.placed(page.marks),
              [&](const std::string& name) { return taps.holds(name); }});
  window.end_frame();
  stale = false;
}

const Control* WindowView::Impl::enabled_control(const std::string& name) const {
  const auto found = std::ranges::find(page.controls, name, &Control::name);
  return found != page.controls.end() && found->enabled ? &*found : nullptr;
}

std::optional<std::string> WindowView::Impl::target_at(float x, float y) const {
  for (const Control& control : page.controls)
    if (control.area.contains(x, y))
      return control.enabled ? std::optional(control.name) : std::nullopt;
  const auto slot = scene.slot_near(x, y, around * measures.target);
  if (!slot) return std::nullopt;
  const std::string name = fmt::format("cube_{}", *slot);
  return enabled_control(name) ? std::optional(name) : std::nullopt;
}

void WindowView::Impl::down(Taps::Pointer pointer, float x, float y, double t_s) {
  if (t_s < page_since_s + settle_s) return;
  if (const auto target = target_at(x, y)) {
    taps.down(pointer, *target);
    stale = true;
  }
}

void WindowView::Impl::up(Taps::Pointer pointer, float x, float y, double t_s) {
  const auto target = target_at(x, y);
  stale = true;
  if (taps.up(pointer, target)) apply(*enabled_control(*target), t_s);
}

void WindowView::Impl::key(char key, double t_s) {
  if (t_s < page_since_s + settle_s) return;
  const auto found = std::ranges::find_if(
      page.controls, [&](const Control& control) { return control.key == key && control.enabled; });
  if (found != page.controls.end()) apply(*found, t_s);
}

void WindowView::Impl::apply(const Control& control, double t_s) {
  if (auto touch = screens.tapped(control)) report(std::move(*touch), t_s);
  lay_out();
}

void WindowView::Impl::report(Touch touch, double t_s) {
  touch.monotonic_s = t_s;
  touches.push_back(std::move(touch));
}

void WindowView::Impl::handle(const SDL_Event& event) {
  const double t_s = sdl_start + event.common.timestamp * 1e-3;
  const auto mouse_at = [&](Sint32 place) { return static_cast<float>(place) * window.scale(); };
  switch (event.type) {
    case SDL_FINGERDOWN:
      SDL_ShowCursor(SDL_DISABLE);
      return down(event.tfinger.fingerId, event.tfinger.x * measures.width,
                  event.tfinger.y * measures.height, t_s);
    case SDL_FINGERUP:
      return up(event.tfinger.fingerId, event.tfinger.x * measures.width,
                event.tfinger.y * measures.height, t_s);
    case SDL_MOUSEMOTION:
      SDL_ShowCursor(SDL_ENABLE);
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
      if (event.key.keysym.sym == SDLK_F11) return window.toggle_full_screen();
      if (const auto pressed = key_of(event.key.keysym)) key(*pressed, t_s);
      return;
    case SDL_WINDOWEVENT:
      return lay_out();  // perhaps resized, perhaps uncovered
    case SDL_QUIT:
      return report(touch_of(TouchKind::close), t_s);
  }
}

void WindowView::Impl::handle_pending() {
  for (SDL_Event event; SDL_PollEvent(&event) != 0;) handle(event);
}

WindowView::WindowView(const ViewSetup& setup) : impl_(std::make_unique<Impl>(setup)) {}

WindowView::~WindowView() = default;

std::optional<double> WindowView::present(const ViewPicture& shown, const ScreenState& screen) {
  impl_->handle_pending();  // what was tapped so far was meant for the page before
  impl_->show(shown, screen);
  impl_->draw();
  const double presented_s = monotonic_s();
  SDL_PumpEvents();  // events get their times here
  return presented_s;
}

std::vector<Touch> WindowView::wait(double seconds) {
  const double end_s = monotonic_s() + seconds;
  for (;;) {
    impl_->handle_pending();
    if (impl_->stale) impl_->draw();
    const double left_s = end_s - monotonic_s();
    if (!impl_->touches.empty() || left_s <= 0) break;
    SDL_WaitEventTimeout(nullptr, static_cast<int>(std::ceil(left_s * 1e3)));
  }
  return std::exchange(impl_->touches, {});
}

const std::vector<Control>& WindowView::controls() const {
  return impl_->page.controls;
}

std::optional<std::string> WindowView::target_at(float x, float y) const {
  return impl_->target_at(x, y);
}

}  // namespace heft
