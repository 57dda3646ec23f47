// A body's tags as measured in single pictures, for the calibrations: they compare many pictures,
// where the tracker looks at one.
#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <string>
#include <vector>

#include "base/Image.h"
#include "tracking/detection/TagDetector.h"
#include "tracking/detection/TagFamily.h"
#include "tracking/pose/MarkerBody.h"

namespace heft {

/// One tag of one picture.
struct SeenTag {
  std::size_t tag = 0;  ///< place in the body's tags
  std::array<Eigen::Vector2d, 4> corners_px;
};

struct TagView {
  std::string name;  ///< of the picture, for messages
  std::vector<SeenTag> tags;
};

/// Detects tags and measures their edges. One viewer is used by one thread.
class TagViewer {
 public:
  /// @throws Error for a family that the detector does not have
  explicit TagViewer(const MarkerBody& body);
  /// Tags with four clear edges. @param image 1 or 3 channels  @param camera how far the lens bends
  /// edges; a guess without distortion does for choosing pictures
  TagView view(const Image& image, const Intrinsics& camera);

 private:
  TagDetector detector_;
  std::vector<TagPattern> patterns_;
  std::map<int, std::size_t> place_;  ///< of an id among the body's tags
};

/// How far a view is from another: the mean way of the corners that both have, pixels; infinite
/// where they have no tag in common.
double difference_px(const TagView& a, const TagView& b);

/// How a tag's corners move when its four edges move outwards by a pixel.
std::array<Eigen::Vector2d, 4> outward_moves(const std::array<Eigen::Vector2d, 4>& corners_px);

}  // namespace heft
