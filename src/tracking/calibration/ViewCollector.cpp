#include "tracking/calibration/ViewCollector.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/Error.h"
#include "base/Names.h"

namespace heft {

namespace {
constexpr int enough_tilted = 2;
constexpr double enough_coverage = 0.75;
constexpr double enough_distance_ratio = 1.2;
constexpr double steady_px = 1.5;     // between consecutive pictures
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
  ++n_offered_;
  last_image_ = image;
  const TagView before = std::move(last_);
  last_ = viewer_.view(image, guess_);
  const TagView& view = last_;
  const auto skipped = [](std::size_t& count) { return ++count, false; };
  if (full()) return false;
  if (view.tags.size() < least_tags_of_a_view) return skipped(n_without_board_);
  if (live_ && difference_px(view, before) > steady_px) return skipped(n_moving_);
  for (const TagView& kept : views_)
    if (difference_px(view, kept) < least_difference_px_) return skipped(n_alike_);
  views_.push_back(view);
  pictures_.push_back(image);
  names_.push_back(name);
  coverage_.add(view, guess_.width_px, guess_.height_px);
  count_pose(view);
  return true;
}

void ViewCollector::count_pose(const TagView& view) {
  const auto pose = rough_pose(board_, guess_, view);
  if (!pose) return;
  const Eigen::Vector3d normal = pose->orientation * Eigen::Vector3d::UnitZ();
  // The board's front faces away from its nearer side.
  if (normal.x() > tilted_sine) ++tilted_[right];
  if (normal.x() < -tilted_sine) ++tilted_[left];
  if (normal.y() > tilted_sine) ++tilted_[lower];
  if (normal.y() < -tilted_sine) ++tilted_[upper];
  const double distance_m = pose->position_m.norm();
  nearest_m_ = nearest_m_ > 0 ? std::min(nearest_m_, distance_m) : distance_m;
  farthest_m_ = std::max(farthest_m_, distance_m);
}

bool ViewCollector::complete() const {
  return size() >= enough && wanted().empty();
}

std::vector<std::string> ViewCollector::missing() const {
  constexpr std::array<const char*, 4> sides{"left", "right", "upper", "lower"};
  std::vector<std::string> list;
  // The side that was tilted least is wanted first.
  const auto least = std::ranges::min_element(tilted_);
  if (*least < enough_tilted)
    list.push_back(fmt::format("tilt the board: its {} side away from the camera",
                               sides[static_cast<std::size_t>(least - tilted_.begin())]));
  if (coverage_.fraction() < enough_coverage)
    list.push_back(fmt::format("bring the board into {} of the picture, and hold it still",
                               coverage_.emptiest()));
  if (farthest_m_ < enough_distance_ratio * nearest_m_)
    list.emplace_back("bring the board nearer and farther away");
  if (size() < enough)
    list.push_back(fmt::format("{} more views, from other sides and distances", enough - size()));
  return list;
}

// The first views may be from anywhere.
std::string ViewCollector::wanted() const {
  const std::vector<std::string> list = missing();
  if (list.empty()) return "";
  return size() < enough / 4 ? list.back() : list.front();
}

std::string ViewCollector::tally() const {
  std::string text = fmt::format("of {} {} were kept",
                                 counted(static_cast<std::int64_t>(n_offered_), "picture"), size());
  const auto add = [&](std::size_t n, const char* why) {
    if (n > 0) text += fmt::format("; {} {}", n, why);
  };
  add(n_without_board_, "don't show the board clearly (4 tags or more)");
  add(n_moving_, "were taken while it moved");
  add(n_alike_, "are too similar to one that was kept");
  return text;
}

namespace {
constexpr double least_difference = 0.01;  // of the picture's width
}

EffectorViews::EffectorViews(const MarkerBody& effector, const Intrinsics& camera)
    : effector_(effector), camera_(camera), viewer_(effector), counts_(effector.tags.size()) {}

void EffectorViews::offer(const Image& image, const std::string& name) {
  require_size(image, name);
  TagView view = viewer_.view(image, camera_);
  view.name = name;
  if (view.tags.size() < 2 || full()) return;
  for (const TagView& kept : views_)
    if (difference_px(view, kept) < camera_.width_px * least_difference) return;
  for (const SeenTag& seen : view.tags) ++counts_[seen.tag];
  views_.push_back(std::move(view));
}

bool EffectorViews::complete() const {
  return views_.size() >= enough && std::ranges::min(counts_) >= enough_of_a_tag;
}

std::string EffectorViews::counts() const {
  std::string text = fmt::format("{} pictures;", views_.size());
  for (std::size_t i = 0; i < counts_.size(); ++i)
    text += fmt::format(" tag {}: {}", effector_.tags[i].id, counts_[i]);
  return text;
}

void EffectorViews::require_size(const Image& image, const std::string& name) const {
  if (image.width == camera_.width_px && image.height == camera_.height_px) return;
  throw Error(fmt::format("{} is {} x {} pixels, but the camera was calibrated at {} x {}", name,
                          image.width, image.height, camera_.width_px, camera_.height_px));
}

}  // namespace heft
