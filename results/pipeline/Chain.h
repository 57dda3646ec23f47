// One picture's way through a session, stage by stage, each timed: what the runner does with it,
// without the log.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apparatus/TrialWorld.h"
#include "apparatus/sources/FilmedPictures.h"
#include "base/Names.h"
#include "protocol/Protocol.h"
#include "results/Study.h"
#include "tracking/detection/MarkerBody.h"
#include "view/scene/SceneDrawing.h"

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

// What the stages cost, and its chart.

struct BudgetLine {
  std::string stage;
  double median_ms = 0, p95_ms = 0;
};

struct Budget {
  int width_px = 0;
  std::vector<BudgetLine> stages;  ///< in their order
  BudgetLine whole;                ///< all but physics, of the same picture
  int n_pictures = 0;

  /// The project's goal for the whole picture without physics.
  double goal_ms() const { return width_px == 640 ? 8 : 15; }
};

/// Stacked bars with each stage's median, one a picture size, and the goals.
std::string pipeline_chart(const std::vector<Budget>& budgets, const StudyOptions& options);

// heft bench pipeline: what each stage from a camera's picture to the shown one costs, and whether
// memory stays flat over an hour.

void run_pipeline_study(const StudyOptions& options);

// Camera pictures of a trial as files, as a camera's JPEG stream or a recording would give them.

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
