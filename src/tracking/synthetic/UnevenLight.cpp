#include "tracking/synthetic/UnevenLight.h"

#include <algorithm>

namespace heft {

namespace {
constexpr float penumbra_px = 2;
constexpr float across_x = 0.8F, across_y = 0.6F;  // the shadow's edge is at a slant to the tags
}  // namespace

UnevenLight::UnevenLight(const Optics& optics, int width_px)
    : shadow_(static_cast<float>(optics.shadow)),
      glare_(static_cast<float>(optics.glare)),
      glare_px_(static_cast<float>(width_px) / 16),
      width_(width_px),
      curve_(optics),
      light_(light_of_levels()) {}

float UnevenLight::lit(float right_px, float down_px) const {
  const float across_px = across_x * right_px + across_y * down_px;
  return 1 - shadow_ * std::clamp(0.5F - across_px / penumbra_px, 0.0F, 1.0F);
}

float UnevenLight::reflected(float right_px, float down_px) const {
  const float squared = (right_px * right_px + down_px * down_px) / (glare_px_ * glare_px_);
  return squared < 30 ? glare_ * std::exp2(-squared) : 0;
}

Levels UnevenLight::on(const Levels& even, const std::optional<Eigen::Vector2d>& at_px) const {
  Levels uneven;
  uneven.reserve(even.size());
  const int n_pixels = static_cast<int>(even.size() / 3);
  for (int i = 0; i < n_pixels; ++i) {
    float gain = 1, more = 0;
    if (at_px) {
      const auto right_px = static_cast<float>(i % width_ - at_px->x());
      const auto down_px = static_cast<float>(i / width_ - at_px->y());
      gain = lit(right_px, down_px);
      more = reflected(right_px, down_px);
    }
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const auto level = even[3 * static_cast<std::size_t>(i) + channel];
      const float light = gain * light_[static_cast<std::size_t>(level)] + more;
      constexpr auto most = static_cast<float>(most_light);
      uneven.push_back(curve_.at(LevelCurve::place_of(std::min(light, most))));
    }
  }
  return uneven;
}

}  // namespace heft
