#include "tracking/pose/CellBias.h"

#include <algorithm>
#include <cmath>

#include "tracking/pose/DensePose.h"

namespace heft {

namespace {
constexpr BiasPrior any_bias{0, 1};
constexpr std::size_t least_tags = 4;
constexpr double most_bias_sd_px = 0.03;

double side_m(const TagObservation& tag) {
  return (tag.corners_m[1] - tag.corners_m[0]).norm();
}

// Across the edges of a tag that is seen from the side.
double px_per_m(const TagObservation& tag) {
  const auto length_px = [&](std::size_t i) {
    return tag.px_per_ray * (tag.rays[(i + 1) % 4] - tag.rays[i]).norm();
  };
  const double across_px = tag.area_px2 * 2 / (length_px(1) + length_px(3));
  const double down_px = tag.area_px2 * 2 / (length_px(0) + length_px(2));
  return (across_px + down_px) / 2 / side_m(tag);
}
}  // namespace

std::optional<CellBias> cell_bias(const Image& gray, const Intrinsics& camera,
                                  std::span<const TagPattern> patterns,
                                  std::span<const TagObservation> tags, const BodyFit& board,
                                  const ToneCurve& curve, double noise, std::size_t most) {
  if (tags.size() < least_tags || !(board.bias_sd_px < most_bias_sd_px)) return std::nullopt;
  CellBias result;
  double sum = 0, weights = 0;
  std::vector<double> excesses;
  const std::size_t stride = (tags.size() + most - 1) / most;
  for (std::size_t i = 0; i < tags.size(); i += stride) {
    const TagObservation& tag = tags[i];
    const DenseTag cells{&tag, &patterns[tag.tag]};
    const auto fit =
        align_densely(gray, camera, std::span(&cells, 1), board, any_bias, curve, noise);
    if (!fit || !(fit->bias_sd_px < most_bias_sd_px)) continue;
    const double half_px = px_per_m(tag) * side_m(tag) / 2;
    result.tags.push_back({fit->bias_px, fit->bias_sd_px, px_per_m(tag)});
    excesses.push_back((board.bias_px - fit->bias_px) / half_px);
    const double weight = std::pow(half_px / fit->bias_sd_px, 2);
    sum += weight * excesses.back();
    weights += weight;
  }
  if (excesses.size() < least_tags) return std::nullopt;
  result.tag_excess = sum / weights;
  double squares = 0;
  for (const double excess : excesses) squares += std::pow(excess - result.tag_excess, 2);
  const auto n = static_cast<double>(excesses.size());
  result.sd = std::sqrt(squares / (n - 1) / n);
  return result;
}

}  // namespace heft
