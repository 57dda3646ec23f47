// The edge bias of tags' cells beside that of their borders. Cells are placed relative to the tag,
// so that they show a tone curve's bias and spread ink, but not the tag's size; borders of a
// board's tags, at known distances from each other, show both.
#pragma once

#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "base/Image.h"
#include "base/math/Quantiles.h"
#include "tracking/detection/MarkerBody.h"
#include "tracking/detection/ToneCurve.h"
#include "tracking/pose/BodyPose.h"

namespace heft {

struct CellBias {
  struct OfTag {
    double bias_px, sd_px;  ///< outward displacement of the edges of its black cells
    double px_per_m;        ///< across its edges
  };
  std::vector<OfTag> tags;
  /// Relative excess of the tags' size over the file's, measured against their distances, and its
  /// standard error by the scatter of tags.
  double tag_excess = 0, sd = 0;
};

/// @param patterns of the board's tags  @param tags at most `most` are used, evenly selected
/// @param board from the borders, with its edge bias  @param noise SD of the picture's, gray levels
/// @return none if fewer than four tags are clear, or the borders do not determine the bias
std::optional<CellBias> cell_bias(const Image& gray, const Intrinsics& camera,
                                  std::span<const TagPattern> patterns,
                                  std::span<const TagObservation> tags, const BodyFit& board,
                                  const ToneCurve& curve, double noise, std::size_t most = 1000);

/// Learns from the first pictures whether the board's tags fit the distances between them. If they
/// do not, they would be taken for a tone curve's, which is wrong for the effector.
class TagSizeLearner {
 public:
  /// Whether another picture is wanted.
  bool is_open() const { return n_tried_ < most_tried && excesses_.size() < enough; }
  /// Counts a picture as tried, even if it shows nothing.
  void try_picture() { ++n_tried_; }

  /// @param seen against tags with excess()  @return whether excess() has changed
  bool learn(const CellBias& seen) {
    excesses_.push_back((1 + excess_) * (1 + seen.tag_excess) - 1);
    const double median = *quantile(excesses_, 0.5), before = excess_;
    const double sd = std::hypot(seen.sd, model_sd);
    const bool is_off = std::abs(median) > std::max(least_excess, deviations * sd);
    if (!is_off)
      excess_ = 0;
    else if (std::abs(median - before) > noticeable)
      excess_ = median;
    return excess_ != before;
  }

  /// Relative excess of the tags' size over the file's; 0 unless it is certain.
  double excess() const { return excess_; }

 private:
  static constexpr std::size_t enough = 7;
  static constexpr int most_tried = 21;
  static constexpr double least_excess = 0.003, deviations = 5, noticeable = 0.0003;
  static constexpr double model_sd = 0.0004;  // under film curves

  std::vector<double> excesses_;
  double excess_ = 0;
  int n_tried_ = 0;
};

}  // namespace heft
