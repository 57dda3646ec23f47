// Predicts the effector's pose from its last poses, assuming that the hand's motion continues at a
// limited speed.
#pragma once

#include "base/PoseTypes.h"

namespace heft {

struct SeenEffector {
  double t_s = 0;        ///< TrackedPicture's effector_t_s
  double own_row_s = 0;  ///< by this much later than its picture's
  Pose board_from_effector;
  Velocity velocity{};  ///< mean since the previous picture
  Velocity next{};      ///< mean until the next picture, if its change continues
  int n_poses = 1;      ///< consecutive ones, including this one

  /// Whether it was seen recently enough for a prediction.
  bool is_recent_at(double then_s) const;

  /// @param by velocity, or next, which is more accurate for a hand but amplifies errors of poses
  Pose expected_at(double then_s, const Velocity& by) const;

  bool could_be_at(const Pose& pose, double then_s) const;

  /// The mean velocity from here to the next pose, extrapolated from the interval's middle by the
  /// given number of pictures, with its change since the previous interval. Unchanged if that is
  /// unknown.
  Velocity carried_on(const Velocity& mean, double by_pictures) const;

  /// The state after the next pose, at then_s.
  /// @param n_intervals picture intervals since the last pose, which files without times do not
  ///   show
  SeenEffector moved_to(double then_s, double then_own_row_s, const Pose& pose,
                        int n_intervals) const;
};

/// Normalizes the quaternion, because rounding would accumulate over pictures.
Pose normalized(Pose pose);

}  // namespace heft
