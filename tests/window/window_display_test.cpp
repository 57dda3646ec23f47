// The window on a real X display (Xvfb), full screen, with a real pointer and keyboard (xdotool).
#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>

#include "view/EveryScreen.h"
#include "window/WindowTaps.h"

namespace heft {
namespace {

using testing::SizeIs;

/// A separate X server on a free display, for the lifetime of this object.
class Display {
 public:
  Display() {
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("no pipe");
    server_ = fork();
    if (server_ == 0) run_server(ends[1]);
    close(ends[1]);
    const std::string number = first_line(ends[0]);
    close(ends[0]);
    if (number.empty()) {
      stop();
      throw std::runtime_error("Xvfb does not start; install the package xvfb");
    }
    setenv("DISPLAY", (':' + number).c_str(), 1);
    setenv("SDL_VIDEODRIVER", "x11", 1);
  }
  ~Display() { stop(); }
  Display(const Display&) = delete;
  Display& operator=(const Display&) = delete;

  void stop() {
    if (server_ <= 0) return;
    kill(server_, SIGKILL);
    waitpid(server_, nullptr, 0);
    server_ = 0;
  }

 private:
  // The server writes its number in pieces.
  static std::string first_line(int from) {
    std::string line;
    for (char c; read(from, &c, 1) == 1 && c != '\n';) line += c;
    return line;
  }

  [[noreturn]] static void run_server(int number_to) {
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // ends with a killed test, too
    const std::string descriptor = std::to_string(number_to);
    // Without -noreset the server restarts after its last client and refuses new ones meanwhile.
    execlp("Xvfb", "Xvfb", "-noreset", "-displayfd", descriptor.c_str(), "-screen", "0",
           "1280x800x24", "-nolisten", "tcp", nullptr);
    _exit(127);
  }

  pid_t server_ = 0;
};

void xdotool(const std::string& arguments) {
  ASSERT_EQ(std::system(("xdotool " + arguments).c_str()), 0) << "is xdotool installed?";
}

void click(float x, float y) {
  xdotool(fmt::format("mousemove {:.0f} {:.0f} click 1", x, y));
}

void click(const WindowView& view, const std::string& name) {
  const Rect area = control_named(view, name).area;
  click(center_x(area), center_y(area));
}

std::vector<Touch> settled(WindowView& view) {
  return view.wait(settle_s + 0.05);
}

TEST(WindowOnADisplay, FillsTheDisplayAndTakesClicksAndKeys) {
  const Display display;
  ViewSetup setup = setup_for("fr");
  setup.takes_keys = true;
  WindowView view(setup);
  view.present(picture_of(setup), trial_state("sorting"));
  settled(view);
  int width = 0, height = 0;
  SDL_GetWindowSize(SDL_GL_GetCurrentWindow(), &width, &height);
  EXPECT_EQ(width, 1280);
  EXPECT_EQ(height, 800);

  click(view, "validate");  // not offered yet
  const auto [x, y] = place_in_picture(view, "cube_3");
  click(x, y);
  EXPECT_THAT(settled(view), SizeIs(0));
  click(view, "label_heaviest");
  auto touched = view.wait(10);
  ASSERT_THAT(touched, SizeIs(1));
  EXPECT_EQ(touched[0].action.slot, 3);
  EXPECT_EQ(touched[0].action.label, "heaviest");

  xdotool("key d");
  touched = view.wait(10);
  ASSERT_THAT(touched, SizeIs(1));
  EXPECT_EQ(touched[0].action.kind, "dont_know");
}

TEST(WindowOnADisplay, DoubleClickIsOneTouch) {
  const Display display;
  const ViewSetup setup = setup_for("en", 2);
  WindowView view(setup);
  view.present(picture_of(setup), trial_state("comparison"));
  settled(view);
  const Rect area = control_named(view, "no_difference").area;
  xdotool(fmt::format("mousemove {:.0f} {:.0f} click --repeat 2 --delay 60 1", center_x(area),
                      center_y(area)));
  EXPECT_THAT(view.wait(10), SizeIs(1));
  EXPECT_THAT(view.wait(0.3), SizeIs(0));
}

TEST(WindowOnADisplay, LostDisplayIsExplained) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto lose_display = [] {
    Display display;
    const ViewSetup setup = setup_for("en");
    WindowView view(setup);
    view.present(picture_of(setup), trial_state("sorting"));
    display.stop();
    for (int i = 0; i < 100; ++i) {
      view.present(picture_of(setup), trial_state("sorting"));
      view.wait(0.01);
    }
  };
  EXPECT_EXIT(lose_display(), testing::ExitedWithCode(4), "heft resume");
}

}  // namespace
}  // namespace heft
