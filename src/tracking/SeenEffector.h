// The effector when it was last seen, and what that says of where it is by now: hands go on as they
// did, and are only so fast.
#pragma once

#include "base/PoseTypes.h"

namespace heft {

struct SeenEffector {
  double t_s = 0;        ///< TrackedPicture's effector_t_s
  double own_row_s = 0;  ///< by so much later than its picture's
  Pose board_from_effector;
  Velocity velocity{};  ///< mean since the picture before
  Velocity next{};      ///< mean until the next picture, if it changes as it did
  int n_poses = 1;      ///< in a row, this one with them

  /// Seen so recently that something can be said of it.
  bool tells_of(double then_s) const;

  /// @param by velocity, or next: nearer to where a hand is, and farther off where poses are not
  /// sure
  Pose expected_at(double then_s, const Velocity& by) const;

  bool could_be_at(const Pose& pose, double then_s) const;

  /// The mean velocity from here to the next pose, carried on from the middle between them as it
  /// has changed since this one's: by half a picture to the next pose's own. Itself while nothing
  /// tells how it changes.
  Velocity carried_on(const Velocity& mean, double by_pictures) const;

  /// What it is after the next pose, later, that it could be at.
  SeenEffector moved_on(double then_s, double then_own_row_s, const Pose& pose) const;
};

/// Poses come out of one another picture by picture: rounding must not add up.
Pose normalized(Pose pose);

}  // namespace heft
