// heft bench tracking: how well and how fast poses are found, where that ends, and what filters do
// to them. Everything is filmed by the synthetic camera, so the truth is known.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/PoseTypes.h"
#include "results/Study.h"
#include "results/tracking/Filming.h"

namespace heft {

void run_tracking_study(const StudyOptions& options);

// Error against time per picture for every detector, decimation and refinement: Accuracy.cpp.

struct MethodResult {
  int width_px = 0;
  MethodName name;
  ErrorSummary summary;
};

/// Films strokes at both picture sizes, has every method track them, writes accuracy.csv and
/// accuracy.svg.
std::vector<MethodResult> study_accuracy(const StudyOptions& options, StudyProgress& progress);

/// The sizes that the goals are stated for.
inline constexpr std::array picture_widths_px{640, 1280};
inline std::string size_name(int width_px) {
  return width_px == 640 ? "640x480" : "1280x720";
}

// Where tracking ends: one thing made worse at a time, pictures on their own, ours and what most
// people build side by side: Limits.cpp.

/// What is in front of the camera, and the camera.
struct LimitScene {
  Apparatus apparatus;
  SyntheticSettings settings;
  Take take;
  double t_s = 0;
};

/// One thing that is made worse.
struct Limit {
  std::string name;   ///< in the CSV
  std::string label;  ///< of the axis, with its unit
  bool logarithmic = false;
  std::vector<double> values;  ///< from harmless on
  std::function<LimitScene(double value, std::uint64_t number)> scene;
};

/// All of them at 640x480, otherwise as in the other studies.
std::vector<Limit> limits();

struct LimitPoint {
  std::string limit;
  double value = 0;
  ErrorSummary ours, bias_left_in, plain;  ///< the second: ours without removing the edge bias
};

/// Writes limits.csv and limits.svg.
std::vector<LimitPoint> study_limits(const StudyOptions& options, StudyProgress& progress);

inline constexpr int limit_parts = 9;  ///< of progress

// What cameras, their light and their prints do, one fault at a time, at both sizes:
// FaultStudy.cpp.

struct FaultPoint {
  std::string fault;
  double value = 0;
  int width_px = 0;
  ErrorSummary ours, plain;
};

/// Writes faults.csv and faults.svg.
std::vector<FaultPoint> study_faults(const StudyOptions& options, StudyProgress& progress);

inline constexpr int fault_parts = 2;  ///< of progress

/// None where it was not filmed.
const FaultPoint* point_of(const std::vector<FaultPoint>& points, const std::string& fault,
                           double value, int width_px);

// How far from what noise allows: BoundStudy.cpp.

/// Held grips at one picture size with so many tags in view; RMS distances of the tip.
struct BoundResult {
  int width_px = 0, tags = 1, pictures = 0;        ///< tags: 2 stands for more, too
  double bound_mm = 0, ours_mm = 0, plain_mm = 0;  ///< of the pictures in which ours found it
  double plain_found = 0;                          ///< of them; its errors are of those

  double ratio() const { return ours_mm / bound_mm; }
};

/// Writes bound.csv.
std::vector<BoundResult> study_bound(const StudyOptions& options, StudyProgress& progress);

inline constexpr int bound_parts = 2;  ///< of progress

/// For people.
std::string bound_table(const std::vector<BoundResult>& bounds);

// Jitter at rest against lag in motion, filter by filter, on the poses that our tracker measured:
// Filters.cpp.

class Smoother {
 public:
  virtual ~Smoother() = default;
  virtual Pose update(double t_s, const Pose& measured, double quality) = 0;
  /// meters and radians a second; zero where a filter does not know
  virtual Velocity velocity() const { return {}; }
};

struct SmootherEntry {
  std::string family;   ///< "One-Euro"
  std::string setting;  ///< "1 Hz beta 5"
  std::function<std::unique_ptr<Smoother>()> make;

  std::string name() const { return setting.empty() ? family : family + ", " + setting; }
};

/// None first, ours second. One-Euro: Casiez, Roussel and Vogel, CHI 2012, derivative cutoff 1 Hz.
/// Kalman: position and velocity, white acceleration of a fixed size, whatever the hand does.
const std::vector<SmootherEntry>& smoothers();

struct FilterResult {
  SmootherEntry filter;
  double jitter_mm = 0;  ///< RMS distance of the tip from its mean while held still
  double lag_ms = 0;     ///< the delay that explains strokes best; negative: runs ahead
  double stroke_p95_mm = 0, swipe_p95_mm = 0;  ///< of the tip; swipes at 0.5 m/s
};

/// A tip's path after filtering, for one take.
struct FilteredTake {
  const Take* take;
  std::vector<double> t_s;
  std::vector<Pose> poses;
  std::vector<Velocity> velocities;
};

/// Starts the filter afresh for each take and after each picture without the effector; one entry
/// for each stretch between.
std::vector<FilteredTake> filtered(const MethodFilm& film, const SmootherEntry& filter);

/// RMS distance of the tip from its mean over each stretch's part after settle_s; none when
/// nothing is that long.
std::optional<double> jitter_mm(const std::vector<FilteredTake>& holds,
                                const Eigen::Vector3d& tip_m);

std::vector<FilterResult> study_filters(const GoalFilms& goal_films, const StudyOptions& options);

// The effectors that are shipped, over random grips: Effectors.cpp.

struct EffectorResult {
  EffectorBody body;
  int width_px = 0;
  double two_in_view = 0;  ///< fraction of grips that show two tags or more, by geometry
  double two_faces = 0;    ///< fraction of pictures whose pose came of two faces or more
  ErrorSummary summary;
};

/// heft bench effectors: writes effectors.csv and README.md.
void run_effector_study(const StudyOptions& options);

/// Grips that are held still, each filmed once and on its own.
EffectorResult compare_effector(EffectorBody body, int width_px, int n_grips, std::uint64_t seed);

// The project's goals for tracking and what the study reached: Goals.cpp.

struct Goal {
  std::string what;
  double goal = 0;
  std::string unit;
  bool at_least = false;  ///< false: the figure may be at most the goal
  double reached = 0;     ///< not a number where there were no pictures for it

  bool met() const { return at_least ? reached >= goal : reached <= goal; }
};

/// What all the other parts of the study found.
struct StudyParts {
  std::vector<MethodResult> accuracy;
  std::vector<GoalFilms> films_by_size;  ///< of 640x480 and 1280x720
  std::vector<FilterResult> filters;
  std::vector<LimitPoint> limits;
  std::vector<FaultPoint> faults;
  std::vector<BoundResult> bounds;
};

/// Of what cameras do: FaultGoals.cpp.
std::vector<Goal> fault_goals(const std::vector<FaultPoint>& points);
/// Poses that are false in all pictures of the study.
Goal count_false_poses(const StudyParts& parts);

/// Films for flips, compares effectors and calibrates cameras, too. Writes goals.csv.
std::vector<Goal> study_goals(const StudyParts& parts, const StudyOptions& options,
                              StudyProgress& progress);

inline constexpr int goal_parts = 3;  ///< of progress

/// A table for people.
std::string as_text(const std::vector<Goal>& goals);

/// "0.043 mm": three significant digits.
std::string figure_text(double value, const std::string& unit);

}  // namespace heft
