#include "tracking/calibration/TagViews.h"

#include <Eigen/LU>
#include <limits>

#include "tracking/camera/ImageConversion.h"
#include "tracking/detection/TagEdges.h"

namespace heft {

namespace {
constexpr double least_quality = 0.85;
constexpr double usual_blur_px = 0.7;
constexpr int most_edge_pixels = 1000;  // all of an edge, because time is not critical

// A corner that edge refinement moved far from the detected one is not trusted.
bool near_detected(const MeasuredTag& measured, const DetectedTag& detected) {
  constexpr double furthest_px = 3;
  for (std::size_t c = 0; c < 4; ++c)
    if (!((measured.corners_px[c] - detected.corners_px[c]).norm() < furthest_px)) return false;
  return true;
}
}  // namespace

TagViewer::TagViewer(const MarkerBody& body)
    : detector_(body.family, 1), patterns_(patterns_of(body)) {
  for (std::size_t i = 0; i < body.tags.size(); ++i) place_[body.tags[i].id] = i;
}

TagView TagViewer::view(const Image& image, const Intrinsics& camera) {
  const Image gray = gray_of(image);
  TagView view;
  for (const DetectedTag& detected : detector_.detect(gray, whole(gray))) {
    const auto known = place_.find(detected.id);
    if (known == place_.end()) continue;
    const MeasuredTag measured =
        measure_tag(gray, camera, patterns_[known->second], detected.corners_px,
                    {usual_blur_px, most_edge_pixels});
    if (measured.quality >= least_quality && near_detected(measured, detected))
      view.tags.push_back({known->second, measured.corners_px});
  }
  return view;
}

double difference_px(const TagView& a, const TagView& b) {
  double sum_px = 0;
  int n = 0;
  for (const SeenTag& one : a.tags)
    for (const SeenTag& other : b.tags) {
      if (one.tag != other.tag) continue;
      for (std::size_t c = 0; c < 4; ++c, ++n)
        sum_px += (one.corners_px[c] - other.corners_px[c]).norm();
    }
  return n > 0 ? sum_px / n : std::numeric_limits<double>::infinity();
}

std::array<Eigen::Vector2d, 4> outward_moves(const std::array<Eigen::Vector2d, 4>& corners_px) {
  std::array<Eigen::Vector2d, 4> moves;
  const auto outwards = [&](std::size_t from) -> Eigen::Vector2d {
    const Eigen::Vector2d along = (corners_px[(from + 1) % 4] - corners_px[from]).normalized();
    return {along.y(), -along.x()};  // corners are clockwise, y is down
  };
  for (std::size_t c = 0; c < 4; ++c) {
    Eigen::Matrix2d normals;
    normals << outwards((c + 3) % 4).transpose(), outwards(c).transpose();
    moves[c] = normals.inverse() * Eigen::Vector2d::Ones();
  }
  return moves;
}

}  // namespace heft
