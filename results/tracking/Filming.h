// What the study films, who tracks it, and what they got wrong against the poses that were
// rendered: our tracker with its settings and the comparisons behind one face, on the same pictures
// one after the other, each timed.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/Image.h"
#include "results/Study.h"
#include "results/tracking/Grips.h"
#include "tracking/Tracker.h"

namespace heft {

struct MethodPoses {
  std::optional<Pose> camera_from_board, board_from_effector;
  double quality = 1;
  int n_faces = 0;  ///< of the effector, that its pose was measured on; 0 where a method tells none
  std::optional<double> effector_t_s = std::nullopt;  ///< where a method tells it
};

/// What a method is, in the words of the charts and tables.
struct MethodName {
  std::string detector;    ///< "heft", "apriltag + solvePnP"...
  std::string refinement;  ///< "corners", "edges" or "cells", or one of them "+ bias removed"
  double decimate = 1;
  bool region_of_interest = false;

  bool operator==(const MethodName&) const = default;
};

struct TrackingMethod {
  std::function<MethodPoses(const Image& image, double t_s)> track;
  std::function<void()> reset;  ///< what comes next is no continuation
};

TrackingMethod make_method(const MethodName& name, const Apparatus& apparatus);

/// What our tracker does unless it is told otherwise.
MethodName our_method(int width_px);
/// AprilTag's corners and cv::solvePnP, decimated so that it keeps up: what most people build.
MethodName plain_method(int width_px);

/// Every detector, refinement and decimation; fewer where `quick`.
std::vector<MethodName> all_methods(int width_px, bool quick);

/// One picture, one method.
struct TrackedError {
  std::optional<double> board_mm, board_deg;  ///< none: the board was not found
  std::optional<double> tip_mm, effector_deg, quality;
  double time_ms = 0;  ///< processor time

  /// A pose that is given and is more than 10 mm or 5 deg off.
  bool is_false() const { return tip_mm && (*tip_mm > 10 || *effector_deg > 5); }
};

/// @param tip_m in the effector's frame
TrackedError error_of(const MethodPoses& poses, const Pose& camera_from_board,
                      const Pose& board_from_effector, const Eigen::Vector3d& tip_m);

/// A method's measured pose of a picture, or that there is none.
struct Measured {
  double t_s;
  Pose truth;            ///< board from effector
  int tags_in_view = 0;  ///< of the effector
  MethodPoses poses;
  TrackedError error;
};

struct FilmPlan {
  int width_px = 640;
  Motion motion = Motion::stroke;
  int n_takes = 1, n_pictures = 10;  ///< of each take
  std::uint64_t seed = 1;
  Grip grip = Grip::any;
  EffectorPrint print{};
  Optics optics{};
};

/// What one method made of each take's pictures.
struct MethodFilm {
  std::vector<Take> takes;
  std::vector<std::vector<Measured>> pictures;  ///< of each take

  std::vector<TrackedError> errors() const;
};

/// Films the plan's takes at film_rate_hz from four places and has every method track them, each
/// take from a fresh start. The methods take turns on each picture.
/// @return one for each method
std::vector<MethodFilm> film(const FilmPlan& plan, const std::vector<MethodName>& methods);

/// Of what there is; none of nothing.
struct Quantiles {
  std::optional<double> median, p95;
};

/// What many pictures come to.
struct ErrorSummary {
  int n = 0;
  double board_found = 0, effector_found = 0;  ///< fractions
  Quantiles board_mm, board_deg, tip_mm, effector_deg, quality, time_ms;
  int n_false = 0;
};

/// @param errors at least one
ErrorSummary summary_of(const std::vector<TrackedError>& errors);

/// How many tags of the effector the camera sees well enough to read, by geometry alone: from less
/// than 75 deg off their front, all corners in the picture. Hands are not looked at.
int tags_in_view(const Apparatus& apparatus, const Pose& camera_from_board,
                 const Pose& board_from_effector);

/// In the effector's frame.
Eigen::Vector3d tip_of(const MarkerBody& effector);

/// Of median and p95: not a number where there is none.
double or_nan(const std::optional<double>& value);

/// What the goals are measured on, at one picture size: the same takes by our tracker and by plain
/// AprilTag and PnP.
struct GoalFilms {
  int width_px = 0;
  struct Pair {
    MethodFilm ours, plain;
  };
  Pair strokes, swipes, holds;
};

inline constexpr int goal_film_parts = 3;  ///< of progress, a picture size
GoalFilms film_for_goals(int width_px, bool quick, StudyProgress& progress);

/// Swipes count while they are this fast.
inline constexpr double swiping_m_s = 0.45;

}  // namespace heft
