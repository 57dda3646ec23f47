// The window with events pushed into SDL, on SDL's offscreen display.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <memory>
#include <vector>

#include "base/Clock.h"
#include "base/Error.h"
#include "view/EveryScreen.h"
#include "window/WindowTaps.h"

namespace heft {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

std::vector<std::string> names_of(const std::vector<Control>& controls) {
  std::vector<std::string> names;
  for (const Control& control : controls)
    if (!std::holds_alternative<TurnPart>(control.effect)) names.push_back(control.name);
  return names;
}

constexpr double settled_s = settle_s + 0.05;

class Window : public testing::Test {
 protected:
  Window() {
    setenv("SDL_VIDEODRIVER", "offscreen", 1);
    open(setup_for("en"));
  }

  void open(const ViewSetup& new_setup) {
    view.reset();
    setup = new_setup;
    view = std::make_unique<WindowView>(setup);
  }

  /// Shows a screen and waits until taps on it count.
  void show(const ScreenState& state, bool cubes = true) {
    view->present(picture_of(setup, cubes), state);
    EXPECT_THAT(view->wait(settled_s), IsEmpty());
  }

  std::vector<Touch> touches() { return view->wait(0); }

  std::vector<Touch> after_tap(const std::string& control) {
    tap(*view, control);
    return touches();
  }

  ViewSetup setup;
  std::unique_ptr<WindowView> view;
};

struct Rgb {
  unsigned char red = 0, green = 0, blue = 0;
  bool operator==(const Rgb&) const = default;
};

// What the display shows from a point, from its lower left corner, on.
std::vector<Rgb> shown_pixels(int x, int y, int width, int height) {
  using ReadPixels = void (*)(int, int, int, int, unsigned, unsigned, void*);
  using ReadBuffer = void (*)(unsigned);
  using PixelStore = void (*)(unsigned, int);
  constexpr unsigned front = 0x0404, rgb = 0x1907, bytes = 0x1401, pack_alignment = 0x0d05;
  const auto read_buffer = reinterpret_cast<ReadBuffer>(SDL_GL_GetProcAddress("glReadBuffer"));
  const auto read_pixels = reinterpret_cast<ReadPixels>(SDL_GL_GetProcAddress("glReadPixels"));
  const auto pixel_store = reinterpret_cast<PixelStore>(SDL_GL_GetProcAddress("glPixelStorei"));
  std::vector<Rgb> pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  read_buffer(front);
  pixel_store(pack_alignment, 1);
  read_pixels(x, y, width, height, rgb, bytes, pixels.data());
  return pixels;
}

int shade_in_corner(bool left) {
  int width = 0;
  SDL_GL_GetDrawableSize(SDL_GL_GetCurrentWindow(), &width, nullptr);
  return shown_pixels(left ? 3 : width - 4, 3, 1, 1)[0].green;
}

// Labels on cubes are answers, and must be legible whatever else is over the scene.
TEST_F(Window, HintOnDraggingCoversNoLabel) {
  ViewSetup dragged = setup_for("fr");
  dragged.text_size = 2;
  dragged.dragged = std::make_shared<DraggedEffector>();
  ScreenState state = trial_state("sorting");
  labels_on(state) = {"lightest", "intermediate", "heaviest"};
  const auto n_of_flags = [&] {
    open(setup);
    view->present(picture_of(setup), state);
    int width = 0, height = 0;
    SDL_GL_GetDrawableSize(SDL_GL_GetCurrentWindow(), &width, &height);
    return std::ranges::count(shown_pixels(0, 0, width, height), Rgb{250, 250, 250});
  };
  setup = dragged;
  const auto n_with_hint = n_of_flags();
  setup.dragged.reset();
  const auto n_without = n_of_flags();
  EXPECT_GT(n_without, 10000);
  EXPECT_GT(n_with_hint, 0.9 * static_cast<double>(n_without));
}

TEST_F(Window, PatchChangesOncePerFrame) {
  for (const bool left_handed : {false, true}) {
    ViewSetup with_patch = setup_for("en");
    with_patch.patch = true;
    with_patch.left_handed = left_handed;
    open(with_patch);
    std::vector<int> shades;
    for (int i = 0; i < 6; ++i) {
      view->present(picture_of(setup), trial_state("sorting"));
      shades.push_back(shade_in_corner(!left_handed));
      SDL_Event redraw{};
      redraw.type = SDL_WINDOWEVENT;  // perhaps uncovered
      SDL_PushEvent(&redraw);
      view->wait(0.01);
      EXPECT_EQ(shade_in_corner(!left_handed), shades.back());
    }
    EXPECT_THAT(shades, ElementsAre(255, 0, 255, 0, 255, 0));
  }
}

TEST_F(Window, EveryControlOfEveryScreenReportsItsTouch) {
  for (const NamedScreen& screen : every_screen(shipped_texts("en"))) {
    SCOPED_TRACE(screen.name);
    show(screen.state, screen.cubes);
    for (const std::string& name : names_of(view->controls())) {
      const Control control = control_named(*view, name);  // after the previous taps
      const auto* expected = control.enabled ? std::get_if<Touch>(&control.effect) : nullptr;
      const auto touched = after_tap(name);
      ASSERT_THAT(touched, SizeIs(expected ? 1 : 0)) << name;
      if (!expected) continue;
      EXPECT_EQ(touched[0].kind, expected->kind) << name;
      EXPECT_EQ(touched[0].action.kind, expected->action.kind) << name;
      EXPECT_EQ(touched[0].action.slot, expected->action.slot) << name;
      EXPECT_EQ(touched[0].value, expected->value) << name;
    }
  }
}

TEST_F(Window, MouseAndFrenchTextsWork) {
  open(setup_for("fr", 2));
  show(trial_state("comparison"));
  EXPECT_EQ(control_named(*view, "no_difference").text, "Pas de différence");
  const Rect area = control_named(*view, "cube_2").area;
  tap_with_mouse(center_x(area), center_y(area));
  const auto touched = touches();
  ASSERT_THAT(touched, SizeIs(1));
  EXPECT_EQ(touched[0].action.kind, "select");
  EXPECT_EQ(touched[0].action.slot, 2);
}

TEST_F(Window, DoubleTapCountsOnce) {
  show(trial_state("comparison"));
  tap(*view, "no_difference");
  tap(*view, "no_difference");
  const Rect area = control_named(*view, "no_difference").area;
  push_mouse(SDL_MOUSEBUTTONDOWN, center_x(area), center_y(area), SDL_TOUCH_MOUSEID);
  push_mouse(SDL_MOUSEBUTTONUP, center_x(area), center_y(area), SDL_TOUCH_MOUSEID);
  EXPECT_THAT(touches(), SizeIs(1));
  view->wait(settled_s);
  push_mouse(SDL_MOUSEBUTTONDOWN, center_x(area), center_y(area), SDL_TOUCH_MOUSEID);
  push_mouse(SDL_MOUSEBUTTONUP, center_x(area), center_y(area), SDL_TOUCH_MOUSEID);
  EXPECT_THAT(touches(), IsEmpty()) << "mouse events made from a finger do not count";
}

TEST_F(Window, TapIsDownAndUpOnTheSameControl) {
  show(trial_state("comparison"));
  const Rect one = control_named(*view, "cube_1").area, two = control_named(*view, "cube_2").area;
  push_finger(SDL_FINGERDOWN, center_x(one), center_y(one));
  push_finger(SDL_FINGERUP, center_x(two), center_y(two));
  push_finger(SDL_FINGERDOWN, 1, 1);
  push_finger(SDL_FINGERUP, center_x(two), center_y(two));
  EXPECT_THAT(touches(), IsEmpty());
}

TEST_F(Window, TouchesAreInOrderWithEventTimes) {
  show(trial_state("comparison"));
  constexpr double rounding_s = 0.002;  // SDL counts whole milliseconds
  const double before_s = monotonic_s();
  tap(*view, "cube_2");
  tap(*view, "cube_1");
  const double pushed_s = monotonic_s();
  const auto touched = view->wait(100);  // returns early, or the test times out
  ASSERT_THAT(touched, SizeIs(2));
  EXPECT_EQ(touched[0].action.slot, 2);
  EXPECT_EQ(touched[1].action.slot, 1);
  for (const Touch& touch : touched) {
    EXPECT_GE(touch.monotonic_s, before_s - rounding_s);
    EXPECT_LE(touch.monotonic_s, pushed_s + rounding_s);
  }
}

TEST_F(Window, TapBegunOnPreviousPageIsIgnored) {
  show(page_state(Screen::welcome));
  const Rect area = control_named(*view, "next").area;
  push_finger(SDL_FINGERDOWN, center_x(area), center_y(area));
  view->wait(0);
  show(page_state(Screen::thanks));
  push_finger(SDL_FINGERUP, center_x(area), center_y(area));
  EXPECT_THAT(touches(), IsEmpty());
}

TEST_F(Window, DoubleTapDoesNotSkipAPage) {
  show(page_state(Screen::welcome));
  ASSERT_THAT(after_tap("next"), SizeIs(1));
  view->present(picture_of(setup), page_state(Screen::instructions));
  EXPECT_THAT(after_tap("next"), IsEmpty());
  view->wait(settled_s);
  EXPECT_THAT(after_tap("next"), SizeIs(1));
}

TEST_F(Window, TapBeforeNextFrameBelongsToVisiblePage) {
  show(trial_state("comparison"));
  tap(*view, "no_difference");
  view->present(picture_of(setup), page_state(Screen::rest));
  const auto touched = touches();
  ASSERT_THAT(touched, SizeIs(1));
  EXPECT_EQ(touched[0].action.kind, "no_difference");
}

TEST_F(Window, CubeInPictureActsAsItsButton) {
  show(trial_state("sorting"));
  for (const std::string cube : {"cube_1", "cube_2", "cube_3"}) {
    const auto [x, y] = place_in_picture(*view, cube);
    tap_with_finger(x, y);
    EXPECT_THAT(touches(), IsEmpty());
    EXPECT_TRUE(control_named(*view, cube).chosen) << cube;
  }
  show(trial_state("comparison"));
  const auto [x, y] = place_in_picture(*view, "cube_2");
  tap_with_finger(x, y);
  const auto touched = touches();
  ASSERT_THAT(touched, SizeIs(1));
  EXPECT_EQ(touched[0].action.slot, 2);
}

// With a dragged effector at its place in picture_of().
class WindowToDragIn : public Window {
 protected:
  WindowToDragIn() {
    effector->pose = picture_of(setup).frame.effector;
    setup.dragged = effector;
    open(setup);
  }

  /// The middle of the pixels where the effector can be taken.
  std::pair<float, float> middle_of_effector() {
    show(trial_state("sorting"));
    const Measures all = view->measures();
    float x_sum = 0, y_sum = 0, n = 0;
    for (float y = 0; y < all.height; y += 16)
      for (float x = 0; x < all.width; x += 16) {
        if (!view->is_on_effector(x, y)) continue;
        x_sum += x, y_sum += y, ++n;
      }
    if (n == 0) throw std::out_of_range("no effector is to be dragged");
    return {x_sum / n, y_sum / n};
  }

  std::shared_ptr<DraggedEffector> effector = std::make_shared<DraggedEffector>();
};

TEST_F(WindowToDragIn, EffectorFollowsMouseAndWheelTurnsIt) {
  const auto [x, y] = middle_of_effector();
  const Pose before = effector->pose;
  push_mouse(SDL_MOUSEBUTTONDOWN, x, y);
  push_mouse_motion(x + 60, y - 60);
  EXPECT_THAT(touches(), IsEmpty()) << "not an answer";
  const auto moved_m = effector->pose.position_m - before.position_m;
  EXPECT_GT(moved_m.x(), 0.01);
  EXPECT_GT(moved_m.y(), 0.01);
  EXPECT_EQ(moved_m.z(), 0);
  push_wheel(2);
  push_mouse(SDL_MOUSEBUTTONUP, x + 60, y - 60);
  push_mouse_motion(x - 90, y);
  EXPECT_THAT(touches(), IsEmpty());
  EXPECT_EQ(effector->pose.position_m - before.position_m, moved_m) << "it was let go";
  EXPECT_NEAR(effector->pose.orientation.angularDistance(before.orientation), 0.1745, 1e-3);
}

TEST_F(WindowToDragIn, OneFingerDragsWhileAnotherTaps) {
  const auto [x, y] = middle_of_effector();
  const double before_m = effector->pose.position_m.x();
  push_finger(SDL_FINGERDOWN, x, y, 1);
  tap(*view, "cube_2");
  push_finger(SDL_FINGERMOTION, x + 50, y, 1);
  view->wait(0);
  EXPECT_TRUE(control_named(*view, "cube_2").chosen);
  EXPECT_GT(effector->pose.position_m.x(), before_m);
}

TEST_F(WindowToDragIn, NothingIsDraggedOutsideTrials) {
  const auto [x, y] = middle_of_effector();
  const Pose before = effector->pose;
  push_mouse(SDL_MOUSEBUTTONDOWN, x, y);
  view->wait(0);
  show(page_state(Screen::demonstration));
  push_mouse_motion(x + 60, y);
  push_mouse(SDL_MOUSEBUTTONDOWN, x, y);
  push_mouse_motion(x + 60, y);
  push_wheel(3);
  view->wait(0);
  EXPECT_EQ(effector->pose.position_m, before.position_m);
  EXPECT_EQ(effector->pose.orientation.coeffs(), before.orientation.coeffs());
}

TEST_F(Window, MouseOnlyTapsWithoutDraggedEffector) {
  show(trial_state("sorting"));
  const auto [x, y] = place_in_picture(*view, "cube_2");
  push_mouse(SDL_MOUSEBUTTONDOWN, x, y);
  push_mouse_motion(x + 1, y);
  push_wheel(1);
  push_mouse(SDL_MOUSEBUTTONUP, x + 1, y);
  EXPECT_THAT(touches(), IsEmpty());
  EXPECT_TRUE(control_named(*view, "cube_2").chosen);
}

TEST_F(Window, CubesInPictureAreDisabledBeforeAnswersAreAllowed) {
  ScreenState state = trial_state("comparison");
  show(state);
  const auto [x, y] = place_in_picture(*view, "cube_2");
  state.can_answer = false;
  view->present(picture_of(setup), state);
  tap_with_finger(x, y);
  EXPECT_THAT(touches(), IsEmpty());
}

TEST_F(Window, KeysAreIgnoredUnlessEnabled) {
  show(trial_state("comparison"));
  for (const auto key : {SDL_SCANCODE_1, SDL_SCANCODE_N, SDL_SCANCODE_RETURN}) push_key(key);
  EXPECT_THAT(touches(), IsEmpty());
  show(page_state(Screen::consent));
  for (const auto key : {SDL_SCANCODE_N, SDL_SCANCODE_RETURN}) push_key(key);
  EXPECT_THAT(touches(), IsEmpty());
}

TEST_F(Window, KeysActAsButtons) {
  ViewSetup with_keys = setup_for("en");
  with_keys.takes_keys = true;
  open(with_keys);
  ScreenState state = trial_state("sorting");
  show(state);
  push_key(SDL_SCANCODE_3);
  push_key(SDL_SCANCODE_H);
  push_key(SDL_SCANCODE_RETURN);  // validate is not offered yet
  push_key(SDL_SCANCODE_D);
  push_key(SDL_SCANCODE_BACKSPACE);
  const auto touched = touches();
  ASSERT_THAT(touched, SizeIs(3));
  EXPECT_EQ(touched[0].action.kind, "label");
  EXPECT_EQ(touched[0].action.slot, 3);
  EXPECT_EQ(touched[0].action.label, "heaviest");
  EXPECT_EQ(touched[1].action.kind, "dont_know");
  EXPECT_EQ(touched[2].kind, TouchKind::put_cubes_back);
  state.can_validate = true;
  view->present(picture_of(setup), state);
  push_key(SDL_SCANCODE_RETURN);
  ASSERT_THAT(touches(), SizeIs(1));
}

TEST_F(Window, ClosingIsATouch) {
  show(page_state(Screen::welcome));
  SDL_Event event{};
  event.type = SDL_QUIT;
  SDL_PushEvent(&event);
  const auto touched = touches();
  ASSERT_THAT(touched, SizeIs(1));
  EXPECT_EQ(touched[0].kind, TouchKind::close);
}

TEST_F(Window, ReturnsPresentationTime) {
  const double before_s = monotonic_s();
  const auto presented_s = view->present(picture_of(setup), trial_state("sorting"));
  ASSERT_TRUE(presented_s);
  EXPECT_GE(*presented_s, before_s);
  EXPECT_LE(*presented_s, monotonic_s());
}

TEST_F(Window, LayoutFollowsSize) {
  show(trial_state("sorting"));
  SDL_Window* window = SDL_GL_GetCurrentWindow();
  SDL_SetWindowFullscreen(window, 0);
  for (const auto& [width, height] : {std::pair{1280, 800}, {800, 600}}) {
    SDL_SetWindowSize(window, width, height);
    view->wait(0);
    const Rect validate = control_named(*view, "validate").area;
    EXPECT_LE(validate.right(), static_cast<float>(width));
    EXPECT_GT(validate.right(), 0.9f * static_cast<float>(width));
  }
}

// On the smallest screen, 7" and 1024 x 600, cubes are at least 10 mm wide and can be tapped.
TEST_F(Window, ShownPartEnlargesCubes) {
  setup.windowed = true;
  for (auto& slot_m : setup.stage.slots_m) slot_m.y() = 0;  // as protocols have it
  const auto cube_mm = [&] {
    open(setup);
    SDL_SetWindowSize(SDL_GL_GetCurrentWindow(), 1024, 600);
    ViewFrame shown = picture_of(setup);
    shown.frame.effector = shown.frame.cubes[1];
    shown.frame.clone = shown.frame.cubes[1];
    shown.frame.clone->position_m.x() += setup.stage.cube_size_m;
    view->wait(0);
    view->present(shown, trial_state("sorting"));
    return view->clone_offset_px().value() * 154.2 / 1024;
  };
  const double whole_mm = cube_mm();
  EXPECT_LT(whole_mm, 10);
  setup.shown_m =
      Eigen::AlignedBox3d(Eigen::Vector3d(-0.14, -0.12, 0), Eigen::Vector3d(0.14, 0.15, 0.035));
  EXPECT_GE(cube_mm(), 10);
  view->wait(settled_s);
  const auto [x1, y1] = place_in_picture(*view, "cube_1");
  const auto [x3, y3] = place_in_picture(*view, "cube_3");
  tap_with_finger(x3, y3);
  EXPECT_THAT(touches(), IsEmpty());
  EXPECT_TRUE(control_named(*view, "cube_3").chosen);
  EXPECT_NEAR((x3 - x1) * 154.2 / 1024, cube_mm() * 0.14 / 0.035, 4);
}

TEST_F(Window, ReportsDisplayAndCloneOffset) {
  const auto display = view->display();
  ASSERT_TRUE(display);
  EXPECT_EQ(display->number, 0);
  EXPECT_GT(display->w_px, 100);
  EXPECT_EQ(display->scale, 1);
  ViewFrame shown = picture_of(setup);
  view->present(shown, trial_state("sorting"));
  EXPECT_EQ(view->clone_offset_px(), 0);
  shown.frame.clone->position_m.x() += 0.01;
  view->present(shown, trial_state("sorting"));
  const double offset_px = view->clone_offset_px().value();
  shown.frame.clone->position_m.x() += 0.01;
  view->present(shown, trial_state("sorting"));
  EXPECT_NEAR(view->clone_offset_px().value(), 2 * offset_px, 0.02 * offset_px);
  shown.frame.tracked = false;
  view->present(shown, trial_state("sorting"));
  EXPECT_FALSE(view->clone_offset_px());
  view->present(picture_of(setup), page_state(Screen::rest));
  EXPECT_FALSE(view->clone_offset_px());
}

TEST_F(Window, OpensWindowedOrFullScreenOnChosenDisplay) {
  const auto is_full = [] {
    return (SDL_GetWindowFlags(SDL_GL_GetCurrentWindow()) & SDL_WINDOW_FULLSCREEN_DESKTOP) != 0;
  };
  EXPECT_TRUE(is_full());
  setup.windowed = true;
  open(setup);
  EXPECT_FALSE(is_full());
  setup.display = 7;
  try {
    open(setup);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), ExitCode::device_missing);
    EXPECT_THAT(error.what(), HasSubstr("no display 7"));
  }
}

TEST_F(Window, RecoversFromLostOpenGlContext) {
  show(trial_state("sorting"));
  SDL_GL_DeleteContext(SDL_GL_GetCurrentContext());
  EXPECT_NO_THROW(view->present(picture_of(setup), trial_state("sorting")));
}

// The message of opening a window that must fail.
std::string refusal() {
  try {
    WindowView(setup_for("en"));
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), ExitCode::device_missing);
    return error.what();
  }
  ADD_FAILURE() << "a window was opened";
  return "";
}

TEST(WindowWithoutDisplay, MessageSaysWhatToDo) {
  setenv("SDL_VIDEODRIVER", "x11", 1);
  unsetenv("DISPLAY");
  EXPECT_THAT(refusal(), AllOf(HasSubstr("DISPLAY"), HasSubstr("--view")));
}

TEST(WindowWithoutDisplay, LibrariesPrintNothing) {
  for (const char* name : {"SDL_VIDEODRIVER", "WAYLAND_DISPLAY", "XDG_RUNTIME_DIR"}) unsetenv(name);
  for (const char* display : {"", ":4711"}) {
    setenv("DISPLAY", display, 1);
    testing::internal::CaptureStderr();
    EXPECT_THAT(refusal(), HasSubstr("--view")) << display;
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << display;
  }
}

}  // namespace
}  // namespace heft
