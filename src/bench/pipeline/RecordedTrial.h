// Camera pictures of a trial as files, as a camera's JPEG stream or a recording would give them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tracking/MarkerBody.h"

namespace heft {

/// Films the hand of the participants' demonstration, which pushes the cubes about, into a folder
/// of its own that is gone with this.
class RecordedTrial {
 public:
  /// @throws Error when the folder for temporary files can't be written to
  RecordedTrial(const Apparatus& apparatus, int n_pictures);
  ~RecordedTrial();
  RecordedTrial(const RecordedTrial&) = delete;
  RecordedTrial& operator=(const RecordedTrial&) = delete;

  const std::vector<std::string>& files() const { return files_; }

  static constexpr double rate_hz = 15;

 private:
  std::filesystem::path folder_;
  std::vector<std::string> files_;
};

}  // namespace heft
