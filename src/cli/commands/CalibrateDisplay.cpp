// heft calibrate display: measures the size of the participant's display.
#include <fmt/format.h>
#include <unistd.h>

#include <iostream>
#include <memory>
#include <optional>
#include <string>

#include "base/Error.h"
#include "base/files/TextFile.h"
#include "cli/Commands.h"
#include "cli/console/Terminal.h"
#include "experiment/Stage.h"
#include "protocol/readers/Files.h"
#include "view/Window.h"

namespace heft::cli {

namespace {
struct DisplayOptions {
  int display = 0;
  std::optional<double> width_mm, height_mm, eye_distance_mm;
  std::string out = "display.toml";
};

double asked_mm(const std::string& what, const std::string& option) {
  if (isatty(STDIN_FILENO) != 1)
    throw Error(fmt::format("there is no terminal to ask for {}; give it with {}", what, option),
                ExitCode::usage);
  for (std::string line;;) {
    say("{}, in millimeters: ", what);
    if (!std::getline(std::cin, line)) throw Error("no answer was given", ExitCode::usage);
    if (const auto mm = number_in(line); mm && *mm > 0) return *mm;
    say("expected a number such as 450\n");
  }
}

// Assumes square pixels.
DisplayMeasures by_card(int display) {
  const std::string how =
      "Hold a bank card against the display and adjust the blue rectangle to its size with "
      "the arrow keys (Shift: faster), the wheel or the mouse. Enter accepts, Escape leaves.";
  say("{}\n", how);
  const auto card = window_module().measure_card(display, how);
  if (!card) throw Error("the display was not measured", ExitCode::interrupted);
  const double mm_per_px = card_w_mm / card->w_px;
  const DisplayFacts& facts = card->display;
  return {facts.w_px, facts.h_px, facts.w_px * mm_per_px, facts.h_px * mm_per_px, 0};
}

DisplayMeasures by_ruler(const DisplayOptions& options) {
  const std::vector<DisplayFacts> all = window_module().displays();
  const auto number = static_cast<std::size_t>(options.display);
  if (options.display < 0 || number >= all.size())
    throw Error(fmt::format("there is no display {}; heft doctor prints them", options.display),
                ExitCode::device_missing);
  return {all[number].w_px, all[number].h_px, *options.width_mm, *options.height_mm, 0};
}

void calibrate_the_display(const DisplayOptions& options) {
  require_writable(options.out);
  if (options.width_mm.has_value() != options.height_mm.has_value())
    throw Error("expected both --width-mm and --height-mm, or neither", ExitCode::usage);
  DisplayMeasures measured = options.width_mm ? by_ruler(options) : by_card(options.display);
  measured.eye_distance_mm =
      options.eye_distance_mm
          ? *options.eye_distance_mm
          : asked_mm("from the participant's eyes to the display", "--eye-distance-mm");
  const std::string text = to_toml(measured);
  parse_display(text, options.out);  // invalid measures are not written
  replace_file(options.out, text);
  print("{} x {} pixels are {:.1f} x {:.1f} mm, seen from {:.0f} mm\n", measured.w_px,
        measured.h_px, measured.w_mm, measured.h_mm, measured.eye_distance_mm);
  say("{} is written. Sessions that start in this folder use it, others with --display-file\n",
      options.out);
}

}  // namespace

void add_calibrate_display(Command& parent) {
  Command command = parent.add_command(
      "display", "measure the participant's display, with a bank card held to it",
      {"heft calibrate display", "heft calibrate display --display 1 --eye-distance-mm 450",
       "heft calibrate display --width-mm 154 --height-mm 90 --eye-distance-mm 450"});
  const auto options = std::make_shared<DisplayOptions>();
  command.add_option("--display", &options->display, "its number (heft doctor --list)")
      .shows_default();
  command.add_option("--width-mm", &options->width_mm,
                     "of its picture, measured with a ruler instead");
  command.add_option("--height-mm", &options->height_mm, "likewise");
  command.add_option("--eye-distance-mm", &options->eye_distance_mm,
                     "from the participant's eyes to the display (default: asked for)");
  command.add_option("--out", &options->out, "the file to write").shows_default();
  command.does([options] { calibrate_the_display(*options); });
}

}  // namespace heft::cli
