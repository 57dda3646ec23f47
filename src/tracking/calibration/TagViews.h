// A body's tags as measured in single pictures, for the calibrations, which compare many pictures.
#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <string>
#include <vector>

#include "base/Image.h"
#include "tracking/detection/MarkerBody.h"
#include "tracking/detection/TagDetector.h"
#include "tracking/detection/TagFamily.h"

namespace heft {

/// One tag of one picture.
struct SeenTag {
  std::size_t tag = 0;  ///< index among the body's tags
  std::array<Eigen::Vector2d, 4> corners_px;
};

struct TagView {
  std::string name;  ///< of the picture, for messages
  std::vector<SeenTag> tags;
};

/// Detects tags and measures their edges. Not thread-safe: use one viewer per thread.
class TagViewer {
 public:
  /// @throws Error for an unknown tag family
  explicit TagViewer(const MarkerBody& body);
  /// Tags with four clear edges. @param image 1 or 3 channels  @param camera gives the lens's
  /// bending of edges; one without distortion suffices for choosing pictures
  TagView view(const Image& image, const Intrinsics& camera);

 private:
  TagDetector detector_;
  std::vector<TagPattern> patterns_;
  std::map<int, std::size_t> place_;  ///< index among the body's tags by id
};

/// Difference of two views: the mean distance of their common corners, pixels; infinite without
/// common tags.
double difference_px(const TagView& a, const TagView& b);

/// Displacements of a tag's corners when its four edges move outwards by a pixel.
std::array<Eigen::Vector2d, 4> outward_moves(const std::array<Eigen::Vector2d, 4>& corners_px);

}  // namespace heft
