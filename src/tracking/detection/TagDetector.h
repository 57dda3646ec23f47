// Finds and reads the tags of one family in a gray picture, by libapriltag.
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "base/Image.h"

namespace heft {

/// A detected tag: accurate to about half a pixel, and too small where blur and the tone curve
/// extend white into black (EdgeFit.h is more accurate).
struct DetectedTag {
  int id = 0;
  /// The upright tag's top left, top right, bottom right, bottom left; pixel centers are integers.
  std::array<Eigen::Vector2d, 4> corners_px;
  double decision_margin = 0;  ///< mean contrast of its bits, gray levels
};

/// A part of a picture.
struct Region {
  int x = 0, y = 0, width = 0, height = 0;
};

/// The whole picture.
Region whole(const Image& image);
/// Left or right; both extend beyond the middle, so that each tag is completely in one of them.
Region half_of(const Image& gray, bool left);
/// From the upper left; tags on the border of two are in one of them completely.
Region quarter_of(const Image& gray, int number);

/// Standard deviation of a picture's noise, gray levels, from differences of neighbors on a coarse
/// grid.
double noise_of(const Image& gray);

/// Places where edges of tags are searched.
enum class EdgeSearch {
  above_noise,  ///< above the picture's noise: several times faster, misses only tags in deep
                ///< shadow
  everywhere,   ///< libapriltag's default: also in noise
  sharpened     ///< above the noise of the sharpened picture, for one that is out of focus
};

/// Not thread-safe. Each detector has its own family, without which libapriltag aborts or finds
/// nothing.
class TagDetector {
 public:
  /// @param decimate quads are searched on a picture reduced by this factor, at least 1
  /// @throws Error (usage) for an unknown family
  TagDetector(const std::string& family, double decimate);
  ~TagDetector();
  TagDetector(TagDetector&&) noexcept;
  TagDetector& operator=(TagDetector&&) noexcept;

  /// Tags whose whole border is in the region. @param gray 1 channel, the camera's values (not
  /// linear light)
  std::vector<DetectedTag> detect(const Image& gray, const Region& region,
                                  EdgeSearch search = EdgeSearch::above_noise);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace heft
