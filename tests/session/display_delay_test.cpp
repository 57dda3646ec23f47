// The display's delay, measured by a synthetic camera that films the window on a virtual display.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <deque>
#include <thread>

#include "apparatus/checks/ApparatusCheck.h"
#include "base/Clock.h"
#include "base/Error.h"
#include "base/math/Quantiles.h"
#include "protocol/readers/Files.h"
#include "record/temporary_folder.h"
#include "tracking/camera/LiveCamera.h"
#include "window/WindowView.h"

namespace heft {
namespace {

constexpr double camera_rate_hz = 60, display_delay_s = 0.025, camera_delay_s = 0.040;

void sleep_until(double t_s) {
  std::this_thread::sleep_for(std::chrono::duration<double>(t_s - monotonic_s()));
}

// An X server that keeps its picture in a file.
class FilmedDisplay {
 public:
  FilmedDisplay() {
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) throw Error("no pipe");
    server_ = fork();
    if (server_ == 0) run_server(ends[1]);
    close(ends[1]);
    std::string number;
    for (char c = 0; read(ends[0], &c, 1) == 1 && c != '\n';) number += c;
    close(ends[0]);
    if (number.empty()) throw Error("Xvfb does not start; install the package xvfb");
    setenv("DISPLAY", (':' + number).c_str(), 1);
    setenv("SDL_VIDEODRIVER", "x11", 1);
    const int file = open(folder_.file("Xvfb_screen0").c_str(), O_RDONLY);
    struct stat facts {};
    fstat(file, &facts);
    size_ = static_cast<std::size_t>(facts.st_size);
    bytes_ = static_cast<const std::uint8_t*>(mmap(nullptr, size_, PROT_READ, MAP_SHARED, file, 0));
    close(file);
  }
  ~FilmedDisplay() {
    kill(server_, SIGKILL);
    waitpid(server_, nullptr, 0);
  }
  FilmedDisplay(const FilmedDisplay&) = delete;

  // Every second pixel, green. The file is an X window dump: a header, colors, rows.
  Image picture() const {
    const std::size_t start = word(0) + 12 * word(19), row_bytes = word(12);
    Image image(static_cast<int>(word(4) / 2), static_cast<int>(word(5) / 2), 1);
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        image.pixels[static_cast<std::size_t>(y * image.width + x)] =
            bytes_[start + static_cast<std::size_t>(2 * y) * row_bytes +
                   static_cast<std::size_t>(8 * x + 1)];
    return image;
  }

 private:
  std::size_t word(std::size_t i) const {
    std::size_t value = 0;
    for (std::size_t k = 0; k < 4; ++k) value = 256 * value + bytes_[4 * i + k];
    return value;
  }
  [[noreturn]] void run_server(int number_to) const {
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    execlp("Xvfb", "Xvfb", "-noreset", "-displayfd", std::to_string(number_to).c_str(), "-screen",
           "0", "800x480x24", "-nolisten", "tcp", "-fbdir", folder_.path().c_str(), nullptr);
    _exit(127);
  }

  test::TemporaryFolder folder_;
  pid_t server_ = 0;
  std::size_t size_ = 0;
  const std::uint8_t* bytes_ = nullptr;
};

// A display with a delay, and a camera whose pictures arrive late.
LiveCamera::Grab filming(const FilmedDisplay& display) {
  struct State {
    std::deque<GrabbedPicture> under_way;
    double next_s = monotonic_s();
    std::uint8_t count = 0;
  };
  return [&display, state = std::make_shared<State>()]() -> std::optional<GrabbedPicture> {
    for (;;) {
      if (!state->under_way.empty()) {
        const double arrives_s = state->under_way.front().capture_s + camera_delay_s;
        if (arrives_s < state->next_s) {
          sleep_until(arrives_s);
          GrabbedPicture picture = std::move(state->under_way.front());
          state->under_way.pop_front();
          return picture;
        }
      }
      sleep_until(state->next_s);
      Image image = display.picture();
      image.pixels[0] = ++state->count;  // the noise of a sensor: no two pictures are the same
      state->under_way.push_back({std::move(image), monotonic_s() + display_delay_s});
      state->next_s += 1 / camera_rate_hz;
    }
  };
}

TEST(DisplayDelay, IsThatOfAPanelFilmedByACamera) {
  const FilmedDisplay display;
  ViewSetup setup;
  setup.patch = true;
  WindowView view(setup);
  LiveCamera camera(filming(display));
  const DisplayDelay delay = measure_display_delay(
      camera,
      [&] {
        view.wait(0);
        return *view.present({}, {.screen = Screen::setting_up});
      },
      30);
  EXPECT_LE(delay.n_missed, 1);
  EXPECT_NEAR(delay.mean_light_s(), display_delay_s, 0.003);
  const double arrival_s = quantile(delay.picture_s, 0.5).value_or(0);
  EXPECT_NEAR(arrival_s, display_delay_s + camera_delay_s + 0.5 / camera_rate_hz, 0.006);
  EXPECT_NEAR(delay.between_pictures_s, 1 / camera_rate_hz, 0.002);
  EXPECT_EQ(delay_verdict(delay).verdict, CheckVerdict::ok);
  EXPECT_EQ(delay.figures_ms().at("light_ms"), 1e3 * delay.mean_light_s());
  EXPECT_EQ(delay.figures_ms().at("picture_ms"), 1e3 * arrival_s);
  EXPECT_GE(delay.figures_ms().at("picture_p95_ms"), 1e3 * arrival_s);
}

TEST(DisplayDelay, NeedsAPatchInThePicture) {
  std::uint8_t count = 0;
  LiveCamera camera([&]() -> std::optional<GrabbedPicture> {
    sleep_until(monotonic_s() + 1 / camera_rate_hz);
    Image image(320, 240, 1);
    image.pixels[0] = ++count;
    return GrabbedPicture{std::move(image), monotonic_s()};
  });
  EXPECT_THROW(measure_display_delay(camera, monotonic_s, 3), Error);
}

}  // namespace
}  // namespace heft
