// Keeps a camera's pictures in a folder that `frames:DIR` reads: picture_000001.png..., and their
// times in times.csv. Only where --record-camera says so: pictures of people are personal data.
#pragma once

#include <fstream>
#include <string>

#include "base/Image.h"

namespace heft {

class PictureRecording {
 public:
  /// @throws Error when the folder can't be made or holds pictures already
  explicit PictureRecording(const std::string& folder);

  /// @throws Error when it can't be saved
  void keep(const Image& image, double capture_s);

 private:
  std::string folder_;
  std::ofstream times_;
  int count_ = 0;
};

}  // namespace heft
