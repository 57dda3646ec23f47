#include "results/pipeline/Chain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <optional>

#include "base/Clock.h"
#include "base/Error.h"
#include "base/Pose.h"
#include "results/Study.h"
#include "session/Demonstration.h"
#include "tracking/camera/ImageFile.h"
#include "tracking/synthetic/SyntheticCamera.h"

namespace heft {

namespace {
TrialPlan three_cubes() {
  TrialPlan plan;
  plan.masses_g = {15, 200, 800};
  return plan;
}

ViewSetup view_of(const Protocol& protocol, const Intrinsics& camera) {
  ViewSetup setup;
  setup.stage = stage_of(protocol, 3);
  setup.camera = camera;
  return setup;
}

double& of(StageTimes& times, PictureStage stage) {
  return times[static_cast<std::size_t>(stage)];
}

// Runs the work and returns its processor time.
template <typename Work>
double timed_ms(Work work) {
  const double began_s = thread_cpu_s();
  work();
  return 1e3 * (thread_cpu_s() - began_s);
}
}  // namespace

Chain::Chain(const Apparatus& apparatus)
    : plan_(three_cubes()),
      tracker_(apparatus),
      drawing_(view_of(protocol_, apparatus.camera)),
      shown_(apparatus.camera.width_px, apparatus.camera.height_px, 3) {
  begin_trial();
}

void Chain::begin_trial() {
  tracker_.reset();
  filter_.reset();
  world_.emplace(protocol_, plan_);
}

StageTimes Chain::run(const std::string& file, double t_s) {
  StageTimes times{};
  std::shared_ptr<const Image> image;
  of(times, PictureStage::decode) =
      timed_ms([&] { image = std::make_shared<const Image>(read_image(file)); });
  track(*image, t_s, times);
  TargetSample sample;
  of(times, PictureStage::filter) = timed_ms([&] { sample = smoothed(filter_, tracked_, t_s); });
  ViewFrame picture;
  of(times, PictureStage::physics) =
      timed_ms([&] { picture.frame = world_->advance(sample).frame; });
  picture.camera = image;
  picture.camera_from_board = tracked_.camera_from_board;
  const Image* drawn = nullptr;
  of(times, PictureStage::draw) = timed_ms([&] { drawn = &drawing_.draw(picture); });
  // What a window hands to the display, and a video to its encoder.
  of(times, PictureStage::present) = timed_ms([&] { shown_.pixels = drawn->pixels; });
  return times;
}

// The tracker says where its wall time went; the processor time is shared out like it.
void Chain::track(const Image& image, double t_s, StageTimes& times) {
  const double began_s = monotonic_s();
  const double all_ms = timed_ms([&] { tracked_ = tracker_.track(image, t_s); });
  const double ms_per_wall_s = all_ms / (monotonic_s() - began_s);
  const TrackerTimes& spent = tracked_.times;
  of(times, PictureStage::detect) = spent.detect_s * ms_per_wall_s;
  of(times, PictureStage::refine) = spent.refine_s * ms_per_wall_s;
  of(times, PictureStage::pose) = spent.pose_s * ms_per_wall_s;
  of(times, PictureStage::gray) =
      all_ms - (spent.detect_s + spent.refine_s + spent.pose_s) * ms_per_wall_s;
}

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
