// OpenCV's aruco detector behind the same face as TagDetector.h. Only where the aruco module was
// there at build time.
#pragma once

#ifdef HEFT_HAVE_ARUCO

#include <memory>
#include <string>
#include <vector>

#include "base/Image.h"
#include "tracking/detection/TagDetector.h"

namespace heft {

/// How it refines corners.
enum class ArucoCorners { plain, apriltag };

class ArucoDetector {
 public:
  /// @throws Error for a family other than tag36h11
  ArucoDetector(const std::string& family, ArucoCorners corners);
  ~ArucoDetector();
  ArucoDetector(ArucoDetector&&) noexcept;

  std::vector<DetectedTag> detect(const Image& gray);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace heft

#endif
