#include "tracking/EffectorViews.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/Error.h"

namespace heft {

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
