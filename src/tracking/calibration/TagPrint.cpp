// The size of a board's tags and its ink.
#include <algorithm>
#include <cmath>
#include <optional>

#include "base/math/Quantiles.h"
#include "tracking/calibration/CameraCalibration.h"
#include "tracking/camera/ImageConversion.h"
#include "tracking/detection/TagDetector.h"

namespace heft {

namespace {
constexpr double usual_blur_px = 0.7, least_quality = 0.85;
constexpr int all_edge_pixels = 1000;
constexpr BiasPrior any_bias{0, 1};
constexpr std::size_t least_pictures = 3;

// Errors of the models of edges and cells under film curves, sharpening and bright light.
constexpr double excess_model_sd = 0.0004;
constexpr double least_excess = 0.0015, least_ink_m = 30e-6, least_deviations = 4;
constexpr double least_share = 0.6, most_share = 1.6;  // of the bias, by ink

// Compares borders and cells in one picture.
class PrintViewer {
 public:
  PrintViewer(const MarkerBody& board, const Intrinsics& camera)
      : board_(board), camera_(camera), detector_(board.family, 1), patterns_(patterns_of(board)) {}

  std::optional<CellBias> view(const Image& image) {
    const Image gray = gray_of(image);
    const std::vector<TagObservation> tags = observed(gray);
    const auto body = solve_body(tags, {}, any_bias);
    if (!body) return std::nullopt;
    return cell_bias(gray, camera_, patterns_, tags, *body, ToneCurve(), noise_of(gray));
  }

 private:
  std::vector<TagObservation> observed(const Image& gray) {
    std::vector<TagObservation> tags;
    for (const DetectedTag& detected : detector_.detect(gray, whole(gray))) {
      const auto tag = std::ranges::find(board_.tags, detected.id, &Tag::id);
      if (tag == board_.tags.end()) continue;
      const auto index = static_cast<std::size_t>(tag - board_.tags.begin());
      const MeasuredTag measured = measure_tag(gray, camera_, patterns_[index], detected.corners_px,
                                               {usual_blur_px, all_edge_pixels});
      if (measured.quality < least_quality || measured.saturated > 0) continue;
      tags.push_back(observe(camera_, *tag, measured, patterns_[index].bright_outside));
      tags.back().tag = index;
    }
    return tags;
  }

  const MarkerBody& board_;
  const Intrinsics& camera_;
  TagDetector detector_;
  std::vector<TagPattern> patterns_;
};

// bias = tone + ink * px_per_m, over all tags of all pictures.
void fit_ink(TagPrint& print, const std::vector<CellBias>& views) {
  double n = 0, mean_px = 0, mean_per_m = 0, along = 0, squares = 0, left_px2 = 0;
  const auto each = [&](const auto& add) {
    for (const CellBias& view : views)
      for (const CellBias::OfTag& tag : view.tags) add(tag);
  };
  each(
      [&](const CellBias::OfTag& tag) { ++n, mean_px += tag.bias_px, mean_per_m += tag.px_per_m; });
  mean_px /= n, mean_per_m /= n;
  each([&](const CellBias::OfTag& tag) {
    along += (tag.px_per_m - mean_per_m) * (tag.bias_px - mean_px);
    squares += std::pow(tag.px_per_m - mean_per_m, 2);
  });
  if (!(squares > 0)) return;
  print.ink_m = along / squares;
  each([&](const CellBias::OfTag& tag) {
    left_px2 += std::pow(tag.bias_px - mean_px - print.ink_m * (tag.px_per_m - mean_per_m), 2);
  });
  print.ink_sd_m = std::sqrt(left_px2 / (n - 2) / squares);
  print.bias_px = mean_px;
  print.by_ink_px = print.ink_m * mean_per_m;
}
}  // namespace

bool TagPrint::is_off() const {
  return std::abs(excess) > std::max(least_excess, least_deviations * excess_sd);
}

bool TagPrint::has_spread() const {
  const double share = by_ink_px / bias_px;
  return ink_m > std::max(least_ink_m, least_deviations * ink_sd_m) && share > least_share &&
         share < most_share;
}

TagPrint print_of_tags(const MarkerBody& board, const Intrinsics& camera,
                       const std::vector<Image>& pictures) {
  PrintViewer viewer(board, camera);
  std::vector<CellBias> views;
  for (const Image& picture : pictures)
    if (auto view = viewer.view(picture)) views.push_back(std::move(*view));
  TagPrint print;
  if (views.size() < least_pictures) return print;
  std::vector<double> excesses, deviations;
  for (const CellBias& view : views) excesses.push_back(view.tag_excess);
  print.excess = *quantile(excesses, 0.5);
  for (const double excess : excesses) deviations.push_back(std::abs(excess - print.excess));
  // SD from the median deviation, and standard error of a median (normal distribution).
  constexpr double sd_by_deviation = 1.4826, of_median = 1.2533;
  print.excess_sd =
      std::hypot(excess_model_sd, of_median * sd_by_deviation * *quantile(deviations, 0.5) /
                                      std::sqrt(static_cast<double>(views.size())));
  fit_ink(print, views);
  return print;
}

}  // namespace heft
