// Films takes with the synthetic camera and lets methods track the same pictures one after the
// other, each timed; what they got wrong against the poses that were rendered.
#pragma once

#include <optional>
#include <vector>

#include "bench/tracking/Grips.h"
#include "bench/tracking/Methods.h"

namespace heft {

/// One picture, one method.
struct TrackedError {
  std::optional<double> board_mm, board_deg;  ///< none: the board was not found
  std::optional<double> tip_mm, effector_deg;
  double time_ms = 0;  ///< processor time
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

/// What many pictures come to.
struct ErrorSummary {
  int n = 0;
  double board_found = 0, effector_found = 0;  ///< shares, 0...1
  std::optional<double> board_median_mm, board_p95_mm, board_median_deg, board_p95_deg;
  std::optional<double> tip_median_mm, tip_p95_mm, effector_median_deg, effector_p95_deg;
  double time_median_ms = 0, time_p95_ms = 0;
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

}  // namespace heft
