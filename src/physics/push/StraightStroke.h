// The scenes that `push` and `quasi_static` can represent, seen along one line: the effector moves
// straight and level without turning and pushes at most one cube, squarely enough that the cube
// neither turns nor tips. Anything else is refused with the reason. Places along the line are those
// of the clone's center, in meters from where the effector was when the line began.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "physics/DecouplingSimulator.h"

namespace heft {

class StraightStroke {
 public:
  StraightStroke() = default;
  /// @throws OutsideModel where the scene is not like that from the start
  StraightStroke(const Scene& scene, const Pose& target);

  /// Takes the effector's next pose. The first that differs gives the line its direction.
  /// @return how far along the line it is
  /// @throws OutsideModel when it leaves the line or turns
  double follow(const Pose& target);

  /// Begins a new line at this pose.
  void restart(const Pose& target);

  /// @throws OutsideModel when the cube does not stand on the table there
  void place_cube(std::size_t cube, const Pose& pose);

  /// Where the clone starts.
  double clone_start() const { return clone_start_; }
  bool has_direction() const { return direction_.has_value(); }
  /// Zero as long as the line has none.
  Eigen::Vector3d direction() const { return direction_.value_or(Eigen::Vector3d::Zero()); }

  const Scene& scene() const { return scene_; }

  /// The cube that the clone would touch next, and where along the line.
  std::optional<std::size_t> cube() const { return cube_; }
  double contact() const { return contact_; }

  /// Moves the cube: the clone would touch it there now.
  void move_cube_to(double contact);

  /// @param touching whether the clone pushes the cube
  /// @throws OutsideModel when the cube would turn or tip, or something else is touched
  void check(double clone, bool touching);

  /// @param force_n mean force of the clone on the cube over the last step
  WorldState state(double clone, double clone_m_s, double cube_m_s, double force_n) const;

 private:
  static constexpr double straight_m = 0.05e-3, straight_rad = 1e-3;
  static constexpr double still_m = 1e-9;  ///< below this a direction would be rounding
  static constexpr double still_cosine = 1 - straight_rad * straight_rad / 8;  ///< of half of it

  [[noreturn]] void refuse(double off_m2) const;
  [[noreturn]] void refuse_place(double clone) const;
  void look_ahead();
  void set_direction(const Eigen::Vector3d& direction);
  void check_square() const;
  double turned_aside_m(double aside_m) const;
  double half_along(const Pose& pose, const Eigen::Vector3d& size_m) const;
  bool beside(const Pose& a, const Eigen::Vector3d& a_size_m, const Pose& b,
              const Eigen::Vector3d& b_size_m) const;

  Scene scene_;
  Pose start_;
  std::vector<Pose> cubes_;
  std::optional<Eigen::Vector3d> direction_;
  double clone_start_ = 0;
  std::optional<std::size_t> cube_;
  bool square_ = false;  ///< the cube has been found to be pushed squarely
  double contact_ = 0;
  // The clone would touch a cube behind it below `behind_`, and a second one ahead above
  // `blocked_`; the pushed cube would touch another when `contact_` is above `cube_blocked_`.
  double behind_ = 0, blocked_ = 0, cube_blocked_ = 0;
};

// Here, to be inlined: a step is hardly more.

inline double StraightStroke::follow(const Pose& target) {
  const Eigen::Vector3d moved_m = target.position_m - start_.position_m;
  if (!direction_ && moved_m.norm() >= still_m) set_direction(moved_m);
  const double along = moved_m.dot(direction());
  const double off_m2 = (moved_m - along * direction()).squaredNorm();
  const double turned = std::abs(start_.orientation.dot(target.orientation));
  if (off_m2 > straight_m * straight_m || turned < still_cosine) refuse(off_m2);
  return along;
}

inline void StraightStroke::move_cube_to(double contact) {
  cubes_[*cube_].position_m += (contact - contact_) * *direction_;
  contact_ = contact;
}

inline void StraightStroke::check(double clone, bool touching) {
  if (!direction_) return;
  if (clone < behind_ || clone > blocked_ || (cube_ && contact_ > cube_blocked_))
    refuse_place(clone);
  if (!touching || square_) return;
  check_square();
  square_ = true;
}

}  // namespace heft
