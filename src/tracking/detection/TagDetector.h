// Finds and reads the tags of one family in a gray picture: libapriltag behind a small face.
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "base/Image.h"

namespace heft {

/// A tag as the detector saw it: good to about half a pixel, and too small where the picture's tone
/// curve bleeds white into black (EdgeFit.h does better).
struct DetectedTag {
  int id = 0;
  /// The upright tag's top left, top right, bottom right, bottom left; pixel centers are integers.
  std::array<Eigen::Vector2d, 4> corners_px;
  double decision_margin = 0;  ///< how clearly its bits were black or white, gray levels
};

/// A part of a picture.
struct Region {
  int x = 0, y = 0, width = 0, height = 0;
};

/// The whole picture.
Region whole(const Image& image);

/// Standard deviation of a picture's noise, gray levels, from how neighbors on a coarse grid
/// differ.
double noise_of(const Image& gray);

/// Where edges of tags are searched.
enum class EdgeSearch {
  above_noise,  ///< where there is the contrast of a print in the picture's light: several times
                ///< faster, and finds no fewer but those that lie in a deep shadow
  everywhere    ///< as libapriltag comes: in a camera's noise, too
};

/// One detector is used by one thread and has a family of its own (libapriltag aborts, or goes
/// blind, otherwise).
class TagDetector {
 public:
  /// @param decimate quads are searched on a picture smaller by this factor, at least 1
  /// @throws Error (usage) for a family that the library does not have
  TagDetector(const std::string& family, double decimate);
  ~TagDetector();
  TagDetector(TagDetector&&) noexcept;
  TagDetector& operator=(TagDetector&&) noexcept;

  /// Tags whose whole border lies in the region. @param gray 1 channel; the camera's own values,
  /// not linear light
  std::vector<DetectedTag> detect(const Image& gray, const Region& region,
                                  EdgeSearch search = EdgeSearch::above_noise);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace heft
