#include "tracking/ViewCollector.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/Error.h"

namespace heft {

namespace {
constexpr std::size_t least_tags = 4;
constexpr int enough_tilted = 2;
constexpr double enough_coverage = 0.75;
constexpr double steady_px = 1.5;     // between one picture and the next
constexpr double tilted_sine = 0.26;  // 15 degrees
}  // namespace

ViewCollector::ViewCollector(const MarkerBody& board, int width_px, int height_px, bool live)
    : board_(board),
      guess_(guessed_camera(width_px, height_px)),
      viewer_(board),
      live_(live),
      least_difference_px_(width_px * (live ? 0.06 : 0.01)) {}

bool ViewCollector::offer(const Image& image, const std::string& name) {
  if (image.width != guess_.width_px || image.height != guess_.height_px)
    throw Error(
        fmt::format("{} is {} x {} pixels, but the first picture was {} x {}; calibrate "
                    "from pictures of one size",
                    name, image.width, image.height, guess_.width_px, guess_.height_px));
  const TagView before = std::move(last_);
  last_ = viewer_.view(image, guess_);
  const TagView& view = last_;
  if (full() || view.tags.size() < least_tags) return false;
  if (live_ && difference_px(view, before) > steady_px) return false;
  for (const TagView& kept : views_)
    if (difference_px(view, kept) < least_difference_px_) return false;
  views_.push_back(view);
  pictures_.push_back(image);
  names_.push_back(name);
  coverage_.add(view, guess_.width_px, guess_.height_px);
  count_tilt(view);
  return true;
}

void ViewCollector::count_tilt(const TagView& view) {
  const auto normal = rough_normal(board_, guess_, view);
  if (!normal) return;
  // The board's front looks to where the nearer side is not.
  if (normal->x() > tilted_sine) ++tilted_[right];
  if (normal->x() < -tilted_sine) ++tilted_[left];
  if (normal->y() > tilted_sine) ++tilted_[lower];
  if (normal->y() < -tilted_sine) ++tilted_[upper];
}

bool ViewCollector::complete() const {
  return size() >= enough && wanted().empty();
}

std::string ViewCollector::wanted() const {
  constexpr std::array<const char*, 4> sides{"left", "right", "upper", "lower"};
  const auto least = std::ranges::min_element(tilted_);
  if (*least < enough_tilted && size() >= enough / 4)
    return fmt::format("tilt the board: its {} side away from the camera",
                       sides[static_cast<std::size_t>(least - tilted_.begin())]);
  if (coverage_.share() < enough_coverage)
    return fmt::format("bring the board into {} of the picture, and hold it still",
                       coverage_.emptiest());
  if (size() < enough) return "show it from other sides and distances";
  return "";
}

}  // namespace heft
