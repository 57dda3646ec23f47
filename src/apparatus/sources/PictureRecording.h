// Stores a camera's pictures in a folder that `frames:DIR` reads: picture_000001.png..., their
// times in times.csv, and for a rendered camera the rendered poses in truth.csv. Only with
// --record-camera, and readable by the owner only: pictures of people are personal data.
#pragma once

#include <fstream>
#include <optional>
#include <string>

#include "base/Image.h"
#include "base/PoseTypes.h"

namespace heft {

/// The true poses in a rendered picture.
struct RenderedPoses {
  std::optional<Pose> board_from_effector;  ///< none: out of view
  Pose camera_from_board;
};

class PictureRecording {
 public:
  /// @throws Error if the folder cannot be created or already holds pictures
  explicit PictureRecording(const std::string& folder);

  /// @throws Error if it cannot be saved
  void keep(const Image& image, double capture_s);
  /// Also writes a row of truth.csv: frame (from 0), t_s, and the pose columns of heft track.
  void keep(const Image& image, double capture_s, const RenderedPoses& truth);

 private:
  std::ofstream begun(const std::string& file, const std::string& header) const;

  std::string folder_;
  std::ofstream times_, truth_;
  int count_ = 0;
};

}  // namespace heft
