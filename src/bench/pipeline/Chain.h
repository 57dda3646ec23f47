// One picture's way through a session, stage by stage, each timed: what the runner does with it,
// without the log.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "apparatus/FilmedPictures.h"
#include "apparatus/TrialWorld.h"
#include "base/Names.h"
#include "protocol/Protocol.h"
#include "view/SceneDrawing.h"

namespace heft {

enum class PictureStage { decode, gray, detect, refine, pose, filter, physics, draw, present };
template <>
struct EnumNames<PictureStage> {
  static constexpr std::array<std::string_view, 9> names{
      "decode", "gray", "detect", "refine", "pose", "filter", "physics", "draw", "present"};
};
inline constexpr std::size_t n_stages = EnumNames<PictureStage>::names.size();

/// Processor time of each stage, milliseconds.
using StageTimes = std::array<double, n_stages>;

class Chain {
 public:
  explicit Chain(const Apparatus& apparatus);

  /// New cubes; what comes next is no continuation.
  void begin_trial();

  /// @param file a picture  @param t_s since the trial's start
  StageTimes run(const std::string& file, double t_s);

 private:
  void track(const Image& image, double t_s, StageTimes& times);

  Protocol protocol_;  // all defaults: three cubes, the default simulator
  TrialPlan plan_;
  Tracker tracker_;
  PoseFilter filter_;
  std::optional<TrialWorld> world_;
  SceneDrawing drawing_;
  TrackedPicture tracked_;
  Image shown_;
};

}  // namespace heft
