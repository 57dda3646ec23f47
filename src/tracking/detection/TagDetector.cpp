#include "tracking/detection/TagDetector.h"

#include <apriltag/apriltag.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <opencv2/imgproc.hpp>

#include "tracking/detection/TagFamily.h"

namespace heft {

namespace {
// Correcting two bits would need tables of 35 MB and accept more false tags.
constexpr int bits_corrected = 1;
// libapriltag's thresholding works in tiles and needs several of them.
constexpr int least_side_px = 16;
// Tiles with less contrast are not searched for edges. The library's 5 levels are within a camera's
// noise, so that it follows edges of noise everywhere, which takes most of its time and finds no
// more tags. Dim pictures and pale prints are searched down to their noise.
constexpr int usual_contrast = 30, library_contrast = 5;
constexpr double contrast_fraction = 0.25;  // of the whole picture's
constexpr double noise_range_sd = 8;        // expected range of noise in a tile and its neighbors
// The library's pixel centers are at halves.
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

// Counts of gray levels, or of differences.
struct Histogram {
  std::array<int, 256> counts{};
  int n = 0;

  void add(int value) {
    ++counts[static_cast<std::size_t>(value)];
    ++n;
  }
  // The value below which a fraction of them is; 0 if there are none.
  int quantile(double fraction) const {
    if (n == 0) return 0;
    int before = static_cast<int>(fraction * (n - 1)), value = 0;
    for (; before >= counts[static_cast<std::size_t>(value)]; ++value)
      before -= counts[static_cast<std::size_t>(value)];
    return value;
  }
};

// Calls take(p) for pixels on a coarse grid, each with a neighbor to its right.
template <typename Take>
void each_on_grid(const Image& gray, const Take& take) {
  constexpr int every_px = 8;
  for (int y = 0; y < gray.height; y += every_px)
    for (int x = 0; x + 1 < gray.width; x += every_px)
      take(&gray.pixels[static_cast<std::size_t>(y) * gray.row_bytes() +
                        static_cast<std::size_t>(x)]);
}

// Unsharp masking gives blurred cells the contrast by which the library reads them.
void sharpen(cv::Mat picture) {
  constexpr double sd_px = 2.5, strength = 4;  // read most tags of those tried, at 1.5 px of blur
  cv::Mat smooth;
  cv::GaussianBlur(picture, smooth, {}, sd_px);
  cv::addWeighted(picture, 1 + strength, smooth, -strength, 0, picture);
}

int searched_contrast(const Image& gray) {
  Histogram values;
  each_on_grid(gray, [&](const std::uint8_t* p) { values.add(p[0]); });
  const double contrast = values.quantile(0.99) - values.quantile(0.01);
  const double wanted = std::max(contrast_fraction * contrast, noise_range_sd * noise_of(gray));
  return std::clamp(static_cast<int>(wanted), library_contrast, usual_contrast);
}

// The library lists corners from the bottom left, counter-clockwise.
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

double noise_of(const Image& gray) {
  constexpr double sd_per_median_difference = 1 / 0.954;  // of two normal numbers
  Histogram differences;
  each_on_grid(gray, [&](const std::uint8_t* p) { differences.add(std::abs(p[1] - p[0])); });
  return sd_per_median_difference * differences.quantile(0.5);
}

Region whole(const Image& image) {
  return {0, 0, image.width, image.height};
}

namespace {
// Length of parts of a side, so that they overlap.
int more_than_half(int px) {
  return px * 13 / 20;
}
}  // namespace

Region half_of(const Image& gray, bool left) {
  const int width_px = more_than_half(gray.width);
  return {left ? 0 : gray.width - width_px, 0, width_px, gray.height};
}

Region quarter_of(const Image& gray, int number) {
  const int width_px = more_than_half(gray.width), height_px = more_than_half(gray.height);
  return {number % 2 == 0 ? 0 : gray.width - width_px, number < 2 ? 0 : gray.height - height_px,
          width_px, height_px};
}

struct TagDetector::Impl {
  TagFamilyHandle family;
  std::unique_ptr<apriltag_detector_t, DestroyDetector> detector{apriltag_detector_create()};
  std::vector<std::uint8_t> pixels;  ///< of the region, in contiguous rows
};

TagDetector::TagDetector(const std::string& family, double decimate)
    : impl_(new Impl{make_tag_family(family), {}, {}}) {
  impl_->detector.reset(apriltag_detector_create());
  apriltag_detector_add_family_bits(impl_->detector.get(), impl_->family.get(), bits_corrected);
  impl_->detector->quad_decimate = static_cast<float>(std::max(1.0, decimate));
  impl_->detector->nthreads = 1;
}

TagDetector::~TagDetector() = default;
TagDetector::TagDetector(TagDetector&&) noexcept = default;
TagDetector& TagDetector::operator=(TagDetector&&) noexcept = default;

std::vector<DetectedTag> TagDetector::detect(const Image& gray, const Region& wanted,
                                             EdgeSearch search) {
  const Region region = clipped(wanted, gray);
  const double smallest = least_side_px * static_cast<double>(impl_->detector->quad_decimate);
  if (std::min(region.width, region.height) < smallest) return {};
  const auto row = static_cast<std::size_t>(region.width);
  impl_->pixels.resize(row * static_cast<std::size_t>(region.height));
  for (int y = 0; y < region.height; ++y)
    std::memcpy(&impl_->pixels[static_cast<std::size_t>(y) * row],
                &gray.pixels[static_cast<std::size_t>(region.y + y) * gray.row_bytes() +
                             static_cast<std::size_t>(region.x)],
                row);
  if (search == EdgeSearch::sharpened)
    sharpen({region.height, region.width, CV_8UC1, impl_->pixels.data()});
  impl_->detector->qtp.min_white_black_diff =
      search == EdgeSearch::everywhere ? library_contrast : searched_contrast(gray);
  image_u8_t picture{region.width, region.height, region.width, impl_->pixels.data()};
  const std::unique_ptr<zarray_t, DestroyDetections> found(
      apriltag_detector_detect(impl_->detector.get(), &picture));
  std::vector<DetectedTag> tags;
  for (int i = 0; i < zarray_size(found.get()); ++i) {
    apriltag_detection_t* detection = nullptr;
    zarray_get(found.get(), i, &detection);
    tags.push_back(converted(*detection, region));
  }
  return tags;
}

}  // namespace heft
