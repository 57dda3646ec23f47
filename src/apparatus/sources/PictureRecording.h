// Keeps a camera's pictures in a folder that `frames:DIR` reads: picture_000001.png..., and their
// times in times.csv; of a rendered camera also the poses that were rendered, in truth.csv. Only
// where --record-camera says so, and only for the eyes of who records: pictures of people are
// personal data.
#pragma once

#include <fstream>
#include <optional>
#include <string>

#include "base/Image.h"
#include "base/PoseTypes.h"

namespace heft {

/// What a rendered picture shows, exactly.
struct RenderedPoses {
  std::optional<Pose> board_from_effector;  ///< none: out of view
  Pose camera_from_board;
};

class PictureRecording {
 public:
  /// @throws Error when the folder can't be made or holds pictures already
  explicit PictureRecording(const std::string& folder);

  /// @throws Error when it can't be saved
  void keep(const Image& image, double capture_s);
  /// With a row of truth.csv: frame (from 0), t_s, and the columns of heft track's poses.
  void keep(const Image& image, double capture_s, const RenderedPoses& truth);

 private:
  std::ofstream begun(const std::string& file, const std::string& header) const;

  std::string folder_;
  std::ofstream times_, truth_;
  int count_ = 0;
};

}  // namespace heft
