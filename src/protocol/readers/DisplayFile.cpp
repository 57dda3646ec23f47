// The file that heft calibrate display writes: a display's size and the eyes' distance from it.
#include <fmt/format.h>

#include "experiment/Stage.h"
#include "protocol/readers/Files.h"
#include "protocol/toml/TableReader.h"

namespace heft {

namespace {
constexpr WholeRange sides_px{100, 20000};
constexpr Range sides_mm{20, 5000}, distances_mm{50, 10000};
}  // namespace

DisplayMeasures parse_display(const std::string& text, const std::string& file) {
  Mistakes mistakes(file);
  const TomlTable root = parse_toml(text, file);
  TableReader reader(root, mistakes);
  DisplayMeasures display;
  reader.require({"width_px", "height_px", "width_mm", "height_mm", "eye_distance_mm"});
  reader.read("width_px", display.w_px, sides_px);
  reader.read("height_px", display.h_px, sides_px);
  reader.read("width_mm", display.w_mm, sides_mm);
  reader.read("height_mm", display.h_mm, sides_mm);
  reader.read("eye_distance_mm", display.eye_distance_mm, distances_mm);
  reader.close();
  mistakes.throw_if_any();
  return display;
}

std::string to_toml(const DisplayMeasures& display) {
  return fmt::format(
      "# A display, made by heft calibrate display: sessions use it with --display-file.\n"
      "width_px = {}\nheight_px = {}\nwidth_mm = {:.4g}\nheight_mm = {:.4g}\n"
      "eye_distance_mm = {:.4g}  # from the participant's eyes to the display\n",
      display.w_px, display.h_px, display.w_mm, display.h_mm, display.eye_distance_mm);
}

}  // namespace heft
