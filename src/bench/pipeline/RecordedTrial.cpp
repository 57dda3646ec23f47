#include "bench/pipeline/RecordedTrial.h"

#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <optional>

#include "base/Error.h"
#include "base/Pose.h"
#include "session/Demonstration.h"
#include "tracking/ImageFile.h"
#include "tracking/SyntheticCamera.h"

namespace heft {

namespace {
constexpr std::uint64_t seed = 5;

std::filesystem::path own_folder() {
  std::string name = (std::filesystem::temp_directory_path() / "heft-pipeline-XXXXXX").string();
  if (!mkdtemp(name.data()))
    throw Error(
        fmt::format("no folder for pictures can be made as {}: {}; set TMPDIR to one that "
                    "can be written to",
                    name, std::strerror(errno)));
  return name;
}

// Where the hand is at each picture; none: out of view.
std::vector<std::optional<Pose>> demonstrated(int n_pictures) {
  const Protocol protocol;
  Demonstration demonstration(protocol, {}, seed);
  std::vector<std::optional<Pose>> poses;
  for (int i = 0; i < n_pictures; ++i) {
    const DisplayedFrame frame = demonstration.at(i / RecordedTrial::rate_hz).frame;
    poses.push_back(frame.tracked ? std::optional(frame.effector) : std::nullopt);
  }
  return poses;
}

std::optional<Pose> between(const std::vector<std::optional<Pose>>& poses, double t_s) {
  const double last = static_cast<double>(poses.size() - 1);
  const double at = std::clamp(t_s * RecordedTrial::rate_hz, 0.0, last);
  const auto& from = poses[static_cast<std::size_t>(std::floor(at))];
  const auto& to = poses[static_cast<std::size_t>(std::ceil(at))];
  if (!from || !to) return std::nullopt;
  return interpolate(*from, *to, at - std::floor(at));
}
}  // namespace

RecordedTrial::RecordedTrial(const Apparatus& apparatus, int n_pictures) : folder_(own_folder()) {
  SyntheticCamera camera(apparatus, {}, seed);
  const auto poses = demonstrated(n_pictures);
  for (int i = 0; i < n_pictures; ++i) {
    files_.push_back((folder_ / fmt::format("{:04}.jpg", i)).string());
    write_image(files_.back(), camera.picture([&](double t_s) { return between(poses, t_s); },
                                              i / rate_hz, static_cast<std::uint64_t>(i)));
  }
}

RecordedTrial::~RecordedTrial() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

}  // namespace heft
