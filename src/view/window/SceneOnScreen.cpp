#include "view/window/SceneOnScreen.h"

#include <cmath>
#include <numbers>

namespace heft {

const Image& SceneOnScreen::draw(const ViewPicture& shown) {
  const Image& image = drawing_.draw(shown);
  width_px_ = image.width;
  height_px_ = image.height;
  return image;
}

void SceneOnScreen::place(const std::optional<Rect>& room) {
  area_.reset();
  if (room && width_px_ > 0) area_ = fitted_scene(*room, width_px_, height_px_);
}

std::optional<int> SceneOnScreen::slot_at(float x, float y) const {
  if (!area_ || !area_->contains(x, y)) return std::nullopt;
  // Pixel centers are integers in the frame, halves on the screen.
  return drawing_.slot_at((x - area_->x) / scale() - 0.5, (y - area_->y) / scale() - 0.5);
}

std::optional<int> SceneOnScreen::slot_near(float x, float y, float reach_px) const {
  if (const auto slot = slot_at(x, y)) return slot;
  constexpr int n_directions = 16;
  std::optional<int> near;
  for (int i = 0; i < n_directions; ++i)
    for (const float fraction : {0.5f, 1.f}) {
      const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / n_directions;
      const float radius = fraction * reach_px;
      const auto slot = slot_at(x + radius * std::cos(angle), y + radius * std::sin(angle));
      if (slot && near && slot != near) return std::nullopt;
      if (slot) near = slot;
    }
  return near;
}

std::vector<PlacedMark> SceneOnScreen::placed(const std::vector<CubeMark>& marks) const {
  std::vector<PlacedMark> all;
  if (!area_) return all;
  for (const CubeMark& mark : marks)
    if (const auto place = drawing_.label_place(mark.slot))
      all.push_back({mark, area_->x + static_cast<float>(place->x() + 0.5) * scale(),
                     area_->y + static_cast<float>(place->y() + 0.5) * scale()});
  return all;
}

}  // namespace heft
