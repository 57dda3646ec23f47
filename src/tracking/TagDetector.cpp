#include "tracking/TagDetector.h"

#include <apriltag/apriltag.h>

#include <algorithm>
#include <cstring>

#include "tracking/TagFamily.h"

namespace heft {

namespace {
// Two wrong bits would cost 35 MB of tables and let in more false tags.
constexpr int bits_corrected = 1;
// libapriltag's own thresholding works in tiles and needs a few of them.
constexpr int least_side_px = 16;
// Its pixels' centers lie at halves.
constexpr double center_offset_px = 0.5;

struct DestroyDetector {
  void operator()(apriltag_detector_t* detector) const { apriltag_detector_destroy(detector); }
};

struct DestroyDetections {
  void operator()(zarray_t* detections) const { apriltag_detections_destroy(detections); }
};

Region clipped(const Region& region, const Image& image) {
  const int left = std::clamp(region.x, 0, image.width);
  const int top = std::clamp(region.y, 0, image.height);
  const int right = std::clamp(region.x + region.width, left, image.width);
  const int bottom = std::clamp(region.y + region.height, top, image.height);
  return {left, top, right - left, bottom - top};
}

// The library lists them from the bottom left, counter-clockwise.
DetectedTag converted(const apriltag_detection_t& found, const Region& region) {
  DetectedTag tag{found.id, {}, static_cast<double>(found.decision_margin)};
  for (std::size_t i = 0; i < 4; ++i) {
    const double* corner = found.p[3 - i];
    tag.corners_px[i] = Eigen::Vector2d(corner[0] + region.x - center_offset_px,
                                        corner[1] + region.y - center_offset_px);
  }
  return tag;
}
}  // namespace

Region whole(const Image& image) {
  return {0, 0, image.width, image.height};
}

struct TagDetector::Parts {
  TagFamilyHandle family;
  std::unique_ptr<apriltag_detector_t, DestroyDetector> detector{apriltag_detector_create()};
  std::vector<std::uint8_t> pixels;  ///< of the region, rows together
};

TagDetector::TagDetector(const std::string& family, double decimate)
    : parts_(new Parts{make_tag_family(family), {}, {}}) {
  parts_->detector.reset(apriltag_detector_create());
  apriltag_detector_add_family_bits(parts_->detector.get(), parts_->family.get(), bits_corrected);
  parts_->detector->quad_decimate = static_cast<float>(std::max(1.0, decimate));
  parts_->detector->nthreads = 1;
}

TagDetector::~TagDetector() = default;
TagDetector::TagDetector(TagDetector&&) noexcept = default;
TagDetector& TagDetector::operator=(TagDetector&&) noexcept = default;

std::vector<DetectedTag> TagDetector::detect(const Image& gray, const Region& wanted) {
  const Region region = clipped(wanted, gray);
  const double smallest = least_side_px * static_cast<double>(parts_->detector->quad_decimate);
  if (std::min(region.width, region.height) < smallest) return {};
  const auto row = static_cast<std::size_t>(region.width);
  parts_->pixels.resize(row * static_cast<std::size_t>(region.height));
  for (int y = 0; y < region.height; ++y)
    std::memcpy(&parts_->pixels[static_cast<std::size_t>(y) * row],
                &gray.pixels[static_cast<std::size_t>(region.y + y) * gray.row_bytes() +
                             static_cast<std::size_t>(region.x)],
                row);
  image_u8_t picture{region.width, region.height, region.width, parts_->pixels.data()};
  const std::unique_ptr<zarray_t, DestroyDetections> found(
      apriltag_detector_detect(parts_->detector.get(), &picture));
  std::vector<DetectedTag> tags;
  for (int i = 0; i < zarray_size(found.get()); ++i) {
    apriltag_detection_t* detection = nullptr;
    zarray_get(found.get(), i, &detection);
    tags.push_back(converted(*detection, region));
  }
  return tags;
}

}  // namespace heft
